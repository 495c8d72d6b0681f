// The page: all its files, read into memory once. Only these files can be fetched.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bihive/base/result.h"

namespace bihive::cli {

/// One file of the page, ready to be sent.
struct PageFile {
  std::string type;  ///< MIME type
  std::shared_ptr<const std::string> bytes;
  std::shared_ptr<const std::string> gzip;  ///< the same, packed; null if that is not smaller
  std::string tag;                          ///< of the bytes; different files have different tags
};

/// By the path of the URL: "/index.html", "/assets/page.js".
using PageFiles = std::map<std::string, PageFile>;

/// Packs and tags the bytes; the type follows from the name's ending.
PageFile make_page_file(const std::string& name, std::string bytes);

/// The bytes as a gzip file; empty if zlib has no memory.
std::string packed_by_gzip(const std::string& bytes);

/// Every regular file in and below the folder. Symbolic links and names with a leading dot are left out. Errors: an
/// unreadable file; a folder that is far too large for a page; no index.html.
Result<PageFiles> read_page(const std::string& folder);

/// The folder of the page: the one that the environment variable BIHIVE_PAGE names, else share/bihive/web of this
/// program's installation, else build-web/page beside the build's folder. Empty if there is none.
std::string find_page();

}  // namespace bihive::cli
