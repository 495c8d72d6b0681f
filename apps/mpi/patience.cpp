#include "patience.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string_view>

#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "support/interrupt.h"

namespace bihive::mpi {
namespace {

constexpr int kUsualPatience = 30;
constexpr std::chrono::seconds kTick{1};

}  // namespace

std::optional<int> patience_from_environment() {
  const char* const text = std::getenv("BIHIVE_MPI_PATIENCE");
  if (text == nullptr) return kUsualPatience;
  const std::string_view digits = text;
  if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string_view::npos)
    return std::nullopt;
  return std::atoi(text);
}

void give_up(const std::string& error) {
  say_error(error);
  cli::remove_unfinished();
  _exit(kEnvironment);
}

bool Ticks::wait() {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, kTick, [this] { return ended_; });
}

void Ticks::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

WaitLimit::WaitLimit(int patience_s, const char* missing) {
  if (patience_s == 0) return;
  thread_ = std::thread([this, patience_s, missing] {
    for (int waited_s = 0; ticks_.wait();)
      if (++waited_s >= patience_s)
        give_up("not all ranks have " + std::string(missing) + " within " + std::to_string(patience_s) + " s; " +
                kMorePatience);
  });
}

WaitLimit::~WaitLimit() {
  ticks_.end();
  if (thread_.joinable()) thread_.join();
}

}  // namespace bihive::mpi
