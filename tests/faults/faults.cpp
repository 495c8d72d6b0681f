// A library that goes before the system's (LD_PRELOAD) and lets one call of a program fail: the N-th of a kind.
//
// BIHIVE_FAULT=KIND:N chooses the call, counted from 1; KIND:N+ lets all later ones fail too; KIND:N! ends the program
// by SIGKILL before that call, as a crash of the machine would. Kinds:
//   malloc (and all that reserve memory, also operator new), open, read, write, fsync, close, rename, linkat, unlink,
//   mmap, pthread_create, fchmod, fchown, flock, ftruncate, lseek, access; socket, bind, listen, accept, recv, send
//   (also recvmsg and sendmsg), epoll (its making), mkdir, rmdir; read-short and write-short move one byte, read-eintr
//   and write-eintr move none and say EINTR.
// BIHIVE_FAULT_AFTER=path: calls count from the one that opens this path on.
// BIHIVE_FAULT_ERRNO=number replaces the kind's usual error. BIHIVE_FAULT_NO_TMPFILE=1: no files without names.
// BIHIVE_FAULT_REPORT=path: the library makes this file, and writes into it "fault" when a call failed, and at the end
// of the program "open N", where N descriptors beyond the first three are still open.
// Without BIHIVE_FAULT the report says how often each kind was called: "malloc 1234".
// BIHIVE_FAULT_LATE_LOCKS=N: each flock() waits up to N microseconds first.
// BIHIVE_FAULT_PROGRAM=name: calls of other programs, which the first one starts, neither fail nor count.
//
// Nothing here reserves memory or uses the C++ library.
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

struct Plan {
  char kind[32];
  long at;
  bool and_later, kills, elsewhere;
  int code;  // 0: the usual one
  bool no_tmpfile;
  const char* report;
  const char* after;
  bool ready;
};
Plan plan;
std::atomic<bool> begun{false};
std::atomic<long> calls{0};
// The C library's own dlopen() follows a null pointer where it finds no memory; oneTBB calls it. That is not for this
// program to mend, so memory never ends in there.
thread_local int inside_dlopen = 0;

// All kinds, and how often each was called.
const char* const kKinds[] = {"malloc",      "open",        "read",           "read-short", "read-eintr", "write",
                              "write-short", "write-eintr", "fsync",          "close",      "rename",     "linkat",
                              "unlink",      "mmap",        "pthread_create", "fchmod",     "fchown",     "flock",
                              "ftruncate",   "lseek",       "access",         "socket",     "bind",       "listen",
                              "accept",      "recv",        "send",           "epoll",      "mkdir",      "rmdir"};
constexpr int kKindsCount = sizeof(kKinds) / sizeof(kKinds[0]);
std::atomic<long> calls_of[kKindsCount];

void read_plan() {
  plan.ready = true;
  const char* const text = getenv("BIHIVE_FAULT");
  if (text != nullptr) {
    const char* const colon = strchr(text, ':');
    if (colon != nullptr && static_cast<size_t>(colon - text) < sizeof(plan.kind)) {
      memcpy(plan.kind, text, static_cast<size_t>(colon - text));
      char* end = nullptr;
      plan.at = strtol(colon + 1, &end, 10);
      plan.and_later = *end == '+';
      plan.kills = *end == '!';
    }
  }
  const char* const code = getenv("BIHIVE_FAULT_ERRNO");
  plan.code = code != nullptr ? atoi(code) : 0;
  plan.no_tmpfile = getenv("BIHIVE_FAULT_NO_TMPFILE") != nullptr;
  plan.report = getenv("BIHIVE_FAULT_REPORT");
  plan.after = getenv("BIHIVE_FAULT_AFTER");
  if (plan.after == nullptr) begun = true;
  const char* const program = getenv("BIHIVE_FAULT_PROGRAM");
  plan.elsewhere = program != nullptr && strcmp(program, program_invocation_short_name) != 0;
  if (plan.elsewhere) plan.report = nullptr;
}

void note_opened(const char* path) {
  if (!plan.ready) read_plan();
  if (!begun && path != nullptr && strcmp(path, plan.after) == 0) begun = true;
}

void report(const char* line) {
  if (plan.report == nullptr) return;
  const int before = errno;
  const long file = syscall(SYS_openat, AT_FDCWD, plan.report, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file >= 0) {
    syscall(SYS_write, file, line, strlen(line));
    syscall(SYS_close, file);
  }
  errno = before;
}

void report_number(const char* name, long number) {
  char line[64];
  char* at = line + sizeof(line);
  *--at = 0;
  *--at = '\n';
  do *--at = static_cast<char>('0' + number % 10);
  while ((number /= 10) > 0);
  *--at = ' ';
  const size_t length = strlen(name);
  at -= length;
  memcpy(at, name, length);
  report(at);
}

// Whether this call of a kind fails; sets errno.
bool fails(const char* kind, int code) {
  if (!plan.ready) read_plan();
  if (plan.elsewhere || !begun) return false;
  if (plan.at == 0) {
    for (int i = 0; i < kKindsCount; ++i)
      if (strcmp(kind, kKinds[i]) == 0) ++calls_of[i];
    return false;
  }
  if (strcmp(kind, plan.kind) != 0 || inside_dlopen > 0) return false;
  const long call = ++calls;
  if (call != plan.at && !(plan.and_later && call > plan.at)) return false;
  if (call == plan.at) report("fault\n");
  if (plan.kills) {
    syscall(SYS_kill, syscall(SYS_getpid), SIGKILL);
    while (true) pause();
  }
  errno = plan.code != 0 ? plan.code : code;
  return true;
}

template <class F>
F real(const char* name) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

bool wants_nameless(int flags) {
  if (!plan.ready) read_plan();
  return plan.no_tmpfile && (flags & O_TMPFILE) == O_TMPFILE;
}

// Descriptors that a program leaves open, apart from those that it got.
__attribute__((destructor)) void count_open() {
  if (plan.report == nullptr) return;
  int open_files = 0;
  for (int file = 3; file < 1024; ++file)
    if (syscall(SYS_fcntl, file, F_GETFD) >= 0) ++open_files;
  report_number("open", open_files);
  for (int i = 0; i < kKindsCount; ++i)
    if (calls_of[i] > 0) report_number(kKinds[i], calls_of[i]);
}

}  // namespace

extern "C" {

void* malloc(size_t bytes) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_malloc(bytes);
}
void* calloc(size_t count, size_t bytes) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_realloc(old, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_memalign(alignment, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_memalign(alignment, bytes);
}
int posix_memalign(void** place, size_t alignment, size_t bytes) {
  if (fails("malloc", ENOMEM)) return ENOMEM;
  *place = __libc_memalign(alignment, bytes);
  return *place == nullptr ? ENOMEM : 0;
}

void* dlopen(const char* path, int flags) {
  ++inside_dlopen;
  void* const library = real<void* (*)(const char*, int)>("dlopen")(path, flags);
  --inside_dlopen;
  return library;
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  note_opened(path);
  if (fails("open", EMFILE)) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int open64(const char* path, int flags, ...) __attribute__((alias("open")));
int openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  if (wants_nameless(flags)) {
    errno = EOPNOTSUPP;
    return -1;
  }
  if (fails("open", EMFILE)) return -1;
  return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
}
int openat64(int folder, const char* path, int flags, ...) __attribute__((alias("openat")));
FILE* fopen(const char* path, const char* mode) {
  note_opened(path);
  if (fails("open", EMFILE)) return nullptr;
  return real<FILE* (*)(const char*, const char*)>("fopen")(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  if (fails("open", EMFILE)) return nullptr;
  return real<FILE* (*)(const char*, const char*)>("fopen64")(path, mode);
}
DIR* opendir(const char* path) {
  if (fails("open", EMFILE)) return nullptr;
  return real<DIR* (*)(const char*)>("opendir")(path);
}

ssize_t read(int file, void* bytes, size_t count) {
  if (fails("read", EIO) || fails("read-eintr", EINTR)) return -1;
  const int before = errno;
  if (count > 1 && fails("read-short", 0)) count = 1;
  errno = before;
  return syscall(SYS_read, file, bytes, count);
}
ssize_t pread(int file, void* bytes, size_t count, off_t place) {
  if (fails("read", EIO) || fails("read-eintr", EINTR)) return -1;
  const int before = errno;
  if (count > 1 && fails("read-short", 0)) count = 1;
  errno = before;
  return syscall(SYS_pread64, file, bytes, count, place);
}
ssize_t pread64(int file, void* bytes, size_t count, off_t place) __attribute__((alias("pread")));
ssize_t write(int file, const void* bytes, size_t count) {
  if (fails("write", ENOSPC) || fails("write-eintr", EINTR)) return -1;
  const int before = errno;
  if (count > 1 && fails("write-short", 0)) count = 1;
  errno = before;
  return syscall(SYS_write, file, bytes, count);
}
int fsync(int file) {
  return fails("fsync", EIO) ? -1 : static_cast<int>(syscall(SYS_fsync, file));
}
// Linux closes the file also if it says that something went wrong.
int close(int file) {
  const int done = static_cast<int>(syscall(SYS_close, file));
  return fails("close", EIO) ? -1 : done;
}
int rename(const char* from, const char* to) {
  if (fails("rename", EBUSY)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  if (fails("rename", EBUSY)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, 0));
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned how) {
  if (fails("rename", EINVAL)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, how));
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  if (fails("linkat", EPERM)) return -1;
  return static_cast<int>(syscall(SYS_linkat, from_folder, from, to_folder, to, flags));
}
int unlink(const char* path) {
  return fails("unlink", EACCES) ? -1 : static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, 0));
}
int unlinkat(int folder, const char* path, int flags) {
  return fails("unlink", EACCES) ? -1 : static_cast<int>(syscall(SYS_unlinkat, folder, path, flags));
}
int rmdir(const char* path) {
  return fails("rmdir", EACCES) ? -1 : static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR));
}
// The C library's own calls unlink() and rmdir() where nobody sees it.
int remove(const char* path) {
  const int removed = unlink(path);
  return removed != 0 && errno == EISDIR ? rmdir(path) : removed;
}
int mkdir(const char* path, mode_t mode) {
  return fails("mkdir", EACCES) ? -1 : static_cast<int>(syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}
int mkdirat(int folder, const char* path, mode_t mode) {
  return fails("mkdir", EACCES) ? -1 : static_cast<int>(syscall(SYS_mkdirat, folder, path, mode));
}
void* mmap(void* at, size_t bytes, int protection, int flags, int file, off_t offset) {
  if (fails("mmap", ENOMEM)) return MAP_FAILED;
  return reinterpret_cast<void*>(syscall(SYS_mmap, at, bytes, protection, flags, file, offset));
}
void* mmap64(void* at, size_t bytes, int protection, int flags, int file, off_t offset) __attribute__((alias("mmap")));
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*), void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  if (fails("pthread_create", EAGAIN)) return EAGAIN;
  return real<Create>("pthread_create")(thread, attributes, body, argument);
}
int fchmod(int file, mode_t mode) {
  return fails("fchmod", EPERM) ? -1 : static_cast<int>(syscall(SYS_fchmod, file, mode));
}
int fchown(int file, uid_t user, gid_t group) {
  return fails("fchown", EPERM) ? -1 : static_cast<int>(syscall(SYS_fchown, file, user, group));
}
int flock(int file, int how) {
  if (const char* const late = getenv("BIHIVE_FAULT_LATE_LOCKS")) {
    timespec now = {};
    clock_gettime(CLOCK_MONOTONIC, &now);
    usleep(static_cast<useconds_t>(now.tv_nsec / 1000 % atol(late)));
  }
  return fails("flock", ENOLCK) ? -1 : static_cast<int>(syscall(SYS_flock, file, how));
}
int ftruncate(int file, off_t size) {
  return fails("ftruncate", EIO) ? -1 : static_cast<int>(syscall(SYS_ftruncate, file, size));
}
off_t lseek(int file, off_t place, int whence) {
  return fails("lseek", EINVAL) ? -1 : static_cast<off_t>(syscall(SYS_lseek, file, place, whence));
}
int access(const char* path, int mode) {
  return fails("access", EACCES) ? -1 : static_cast<int>(syscall(SYS_faccessat, AT_FDCWD, path, mode));
}

// Sockets.
int socket(int domain, int type, int protocol) {
  return fails("socket", EMFILE) ? -1 : static_cast<int>(syscall(SYS_socket, domain, type, protocol));
}
int bind(int file, const sockaddr* address, socklen_t bytes) {
  return fails("bind", EADDRNOTAVAIL) ? -1 : static_cast<int>(syscall(SYS_bind, file, address, bytes));
}
int listen(int file, int most) {
  return fails("listen", EADDRINUSE) ? -1 : static_cast<int>(syscall(SYS_listen, file, most));
}
int accept4(int file, sockaddr* address, socklen_t* bytes, int flags) {
  return fails("accept", EMFILE) ? -1 : static_cast<int>(syscall(SYS_accept4, file, address, bytes, flags));
}
int accept(int file, sockaddr* address, socklen_t* bytes) {
  return accept4(file, address, bytes, 0);
}
ssize_t recv(int file, void* bytes, size_t count, int flags) {
  return fails("recv", ECONNRESET) ? -1 : syscall(SYS_recvfrom, file, bytes, count, flags, nullptr, nullptr);
}
ssize_t recvmsg(int file, msghdr* message, int flags) {
  return fails("recv", ECONNRESET) ? -1 : syscall(SYS_recvmsg, file, message, flags);
}
ssize_t send(int file, const void* bytes, size_t count, int flags) {
  return fails("send", EPIPE) ? -1 : syscall(SYS_sendto, file, bytes, count, flags, nullptr, 0);
}
ssize_t sendmsg(int file, const msghdr* message, int flags) {
  return fails("send", EPIPE) ? -1 : syscall(SYS_sendmsg, file, message, flags);
}
int epoll_create1(int flags) {
  return fails("epoll", EMFILE) ? -1 : static_cast<int>(syscall(SYS_epoll_create1, flags));
}

}  // extern "C"
