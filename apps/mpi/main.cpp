// bihive-mpi: pictures and films by the ranks of MPI, with the options of bihive and the same bits.

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "../shared/last_line.h"
#include "bihive/base/fnv.h"
#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/base/version.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/simd/target.h"
#include "command_line.h"
#include "mpi_communicator.h"
#include "patience.h"
#include "rank_watch.h"
#include "support/interrupt.h"

namespace bihive::mpi {
namespace {

using cli::FilmOptions;
using cli::RenderOptions;

constexpr const char* kDistribute = "--distribute";

constexpr const char* kHelp =
    "bihive-mpi: one picture or film by many processes, with the same bits as by one\n"
    "Usage: mpirun -n N bihive-mpi render|film ... [--distribute]\n"
    "\n"
    "The options are those of bihive render and bihive film: see bihive render --help, bihive film --help.\n"
    "Rank 0 reads the input and writes the picture. Of films each rank reads and draws every N-th picture, and rank 0\n"
    "joins them. Without --threads the ranks of a machine share its cores, or keep to those that mpirun gives them.\n"
    "\n"
    "--distribute: each sphere lies on one rank, for sets beyond the memory of a machine. For render alone. Each rank\n"
    "reads its chunk of an NPY, GSD or H5MD file or of a LAMMPS dump; other files are read by rank 0.\n"
    "\n"
    "A rank that has been silent for 30 s ends all. BIHIVE_MPI_PATIENCE=SECONDS in the environment changes that, 0: "
    "never.\n"
    "\n"
    "Examples:\n"
    "  mpirun -n 4 bihive-mpi render demo -o molecule.png --size 8000x6000\n"
    "  mpirun -n 4 bihive-mpi render big.npy -o big.png --distribute\n"
    "  mpirun -n 4 bihive-mpi film run.dump -o run.mp4\n";

// The threads of each rank. default_concurrency() is what mpirun lets this rank run on: all cores, or its own.
int threads_of_rank(const MpiCommunicator& ranks) {
  const int allowed = hardware_threads();
  const long all = sysconf(_SC_NPROCESSORS_ONLN);
  return allowed < all ? allowed : std::max(1, allowed / ranks.size_on_machine());
}

void check_film(const FilmOptions& options) {
  if (options.shard || options.join)
    fail_usage("--shard and --join are what bihive-mpi does by itself", "leave them out, or use bihive film");
}

std::uint64_t hash_of(const std::vector<std::string>& texts) {
  std::uint64_t hash = fnv1a("");
  for (const std::string& text : texts) hash = fnv1a({text.c_str(), text.size() + 1}, hash);  // with the end of each
  return hash;
}

// All ranks must be the same program with the same arguments, even to print help.
void agree_on_arguments(MpiCommunicator& ranks, const std::vector<const char*>& arguments) {
  ranks.agree({{"the program", hash_of({std::string(version()), std::string(commit())})},
               {"the command line", hash_of({arguments.begin() + 1, arguments.end()})}});
}

void run_request(MpiCommunicator& ranks, cli::Request request) {
  if (ranks.distributes() && std::holds_alternative<FilmOptions>(request))
    fail_usage("--distribute is for one picture", "draw a film with all spheres on each rank");
  if (RenderOptions* const render = std::get_if<RenderOptions>(&request)) {
    if (render->threads == 0) render->threads = threads_of_rank(ranks);
    cli::run_render(*render);
  } else if (FilmOptions* const film = std::get_if<FilmOptions>(&request)) {
    check_film(*film);
    FilmOptions of_rank = *film;
    if (of_rank.picture.threads == 0) of_rank.picture.threads = threads_of_rank(ranks);
    of_rank.shard = cli::Shard{ranks.rank(), ranks.size()};
    of_rank.silent = true;
    const Timer timer;
    Bytes done;
    ByteWriter(done).put(cli::run_film(of_rank));
    const std::vector<Bytes> done_by_ranks = ranks.all_gather(done);
    if (ranks.rank() != 0) return;
    FilmOptions joined;
    joined.picture.output = film->picture.output;
    joined.picture.json = film->picture.json;
    joined.codec = film->codec;
    joined.join = true;
    joined.ms_of_shards = timer.elapsed_ms();
    for (const Bytes& one : done_by_ranks) joined.of_shards.add(ByteReader(one).take<cli::FilmTimes>());
    cli::run_film(joined);
  } else if (const cli::HelpText* const help = std::get_if<cli::HelpText>(&request)) {
    print(help->asked_for ? help->text : kHelp);
  } else {
    fail_usage("bihive-mpi has render and film", "bihive has the other commands");
  }
}

bool is_distribute(const char* argument) {
  return std::string(argument) == kDistribute;
}

// The reason why this rank fails, if it does.
struct Said {
  int code = kSuccess;
  std::string text, shown;
};

Said run(MpiCommunicator& ranks, const std::vector<const char*>& arguments) {
  try {
    cli::handle_signals();
    name_settings_as_options();
    agree_on_arguments(ranks, arguments);
    if (const Status status = check_target_environment(); !status) throw Failure{kBadUsage, status.error()};
    // The program's own option is not one of bihive's.
    std::vector<const char*> others = arguments;
    std::erase_if(others, is_distribute);
    const std::string first = others.size() > 1 ? others[1] : "";
    if (others.size() < 2) return {kBadUsage, "", kHelp};
    if (first == "--help" || first == "--help-all" || first == "-h") {
      print(kHelp);
    } else {
      run_request(ranks, cli::parse_command_line(static_cast<int>(others.size()), others.data()));
    }
    finish_output();
    return {};
  } catch (const Failure& failure) {
    return {failure.code, failure.error.to_string(), failure.shown};
  } catch (const cli::OtherRankFailed& other) {
    return {other.code, "", ""};
  } catch (const std::exception& error) {
    // It may have occurred within a picture, while the other ranks wait for this one: MPI ends them.
    const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    say_error(is_memory ? kNoMemory : error.what());
    MPI_Abort(MPI_COMM_WORLD, kBadInput);
    return {kBadInput, "", ""};
  }
}

// All ranks end with the same code, and one of them reports why.
int run_ranks(const std::vector<const char*>& arguments) {
  const bool distributes = std::any_of(arguments.begin(), arguments.end(), is_distribute);
  MpiCommunicator ranks(MPI_COMM_WORLD, distributes, MpiCommunicator::Counting::shared);
  cli::set_communicator(&ranks);
  std::vector<std::string> unsaid;
  if (ranks.rank() != 0 && std::freopen("/dev/null", "w", stdout) == nullptr) return kBadInput;
  if (ranks.rank() == 0) show_progress_in_lines();
  Said said;
  {
    // Rank 0 warns for all.
    std::optional<CollectedWarnings> collected;
    if (ranks.rank() != 0) collected.emplace(unsaid);
    said = run(ranks, arguments);
  }
  const int code = ranks.end_with(said.code);
  if (ranks.speaks()) {
    if (!said.text.empty()) say_error(said.text);
    say_lines(said.shown);
  }
  cli::set_communicator(nullptr);
  return code;
}

void prepare() {
  end_in_one_line(cli::remove_unfinished);
}

// As in bihive: before the shared libraries make their variables.
__attribute__((section(".preinit_array"), used)) void (*const kFirst)() = prepare;

}  // namespace
}  // namespace bihive::mpi

int main(int argc, char** argv) {
  using namespace bihive;  // NOLINT(google-build-using-namespace): of this function alone
  const std::optional<int> patience_s = mpi::patience_from_environment();
  if (!patience_s) {
    say_error("BIHIVE_MPI_PATIENCE must be seconds, or 0 to wait forever");
    return kBadUsage;
  }
  int provided = 0;
  {
    // Programs start slowly on large machines.
    const mpi::WaitLimit limit(*patience_s * 3 / 2, "started this program");
    MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &provided);
  }
  int code = kEnvironment;
  if (provided < MPI_THREAD_SERIALIZED) {
    say_error("this MPI takes calls from the main thread alone");
  } else {
    // With another MPI there is nobody to watch.
    const mpi::RankWatch watch(provided < MPI_THREAD_MULTIPLE ? 0 : *patience_s);
    code = mpi::run_ranks({argv, argv + argc});
  }
  const mpi::WaitLimit limit(*patience_s, "ended");
  MPI_Finalize();
  return code;
}
