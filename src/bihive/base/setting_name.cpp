#include "bihive/base/setting_name.h"

#include <algorithm>
#include <atomic>
#include <cctype>

namespace bihive {
namespace {

std::string the_id(std::string_view id) {
  return std::string(id);
}

std::atomic<std::string (*)(std::string_view)> name_of_setting{&the_id};

}  // namespace

std::string setting_name(std::string_view id) {
  return name_of_setting.load(std::memory_order_relaxed)(id);
}

std::string option_of_setting(std::string_view id) {
  if (!id.empty() && std::isupper(static_cast<unsigned char>(id.front())) != 0) return std::string(id);
  std::string option = "--" + std::string(id);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::string setting_of_option(std::string_view option) {
  if (option.starts_with("--")) option.remove_prefix(2);
  std::string id(option);
  std::replace(id.begin(), id.end(), '-', '_');
  return id;
}

void name_settings_by(std::string (*name)(std::string_view id)) {
  name_of_setting.store(name, std::memory_order_relaxed);
}

}  // namespace bihive
