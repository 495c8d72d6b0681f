// bihive thesis --page: writes the page that measures a phone.
#include <fmt/format.h>

#include "bihive/base/readable.h"
#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "commands/commands.h"
#include "server/page_files.h"
#include "support/outputs.h"

namespace bihive::cli {

void write_phone_page(const std::string& file) {
  check_outputs({file}, {}, /*are_text=*/true);
  const std::string folder = find_page();
  const Result<std::string> page = read_file(folder + "/phone.html");
  if (folder.empty() || !page)
    throw Failure{kEnvironment,
                  {"this bihive was built without the page for phones", "", 0, 0, "run make web where it was built"}};
  if (const Status status = write_file(output_path(file), *page); !status) fail(status.error());
  print_report(fmt::format("{}: {} bytes; open it in the phone's browser\n", escaped(file), grouped(page->size())),
               {file});
}

}  // namespace bihive::cli
