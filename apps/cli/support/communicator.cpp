#include "support/communicator.h"

namespace bihive::cli {
namespace {

PictureCommunicator* of_this_process = nullptr;

}  // namespace

PictureCommunicator* communicator() {
  return of_this_process;
}

void set_communicator(PictureCommunicator* ranks) {
  of_this_process = ranks;
}

}  // namespace bihive::cli
