#include "support/team.h"

namespace bihive::cli {
namespace {

Team* of_this_process = nullptr;

}  // namespace

Team* team() {
  return of_this_process;
}

void set_team(Team* team) {
  of_this_process = team;
}

}  // namespace bihive::cli
