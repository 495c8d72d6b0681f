#include "server/addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>
#include <memory>

#include "bihive/base/parse_number.h"

namespace bihive::cli {
namespace {

std::string spelling(int family, const void* binary) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  return inet_ntop(family, binary, text.data(), text.size()) != nullptr ? std::string(text.data()) : "";
}

}  // namespace

std::optional<std::string> usual_spelling(const std::string& address) {
  in_addr v4{};
  in6_addr v6{};
  // A NUL would end the text early.
  if (address.find('\0') != std::string::npos) return std::nullopt;
  if (inet_pton(AF_INET, address.c_str(), &v4) == 1) return spelling(AF_INET, &v4);
  if (inet_pton(AF_INET6, address.c_str(), &v6) == 1) return spelling(AF_INET6, &v6);
  return std::nullopt;
}

Result<std::string> address_from(const std::string& text) {
  if (const std::optional<std::string> address = usual_spelling(text)) return *address;
  return unexpected("a numeric address such as 0.0.0.0 or 192.168.1.5", text);
}

bool is_loopback(const std::string& address) {
  // "127.0.0.1.example" is a name.
  return address == "::1" || (address.rfind("127.", 0) == 0 && usual_spelling(address));
}

bool is_every_address(const std::string& address) {
  return address == "0.0.0.0" || address == "::";
}

std::vector<std::string> own_addresses(bool with_ipv6) {
  std::vector<std::string> addresses;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return addresses;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || (entry->ifa_flags & IFF_UP) == 0 || (entry->ifa_flags & IFF_LOOPBACK) != 0)
      continue;
    const int family = entry->ifa_addr->sa_family;
    if (family == AF_INET) {
      addresses.push_back(spelling(family, &reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr));
    } else if (family == AF_INET6 && with_ipv6) {
      const in6_addr& v6 = reinterpret_cast<const sockaddr_in6*>(entry->ifa_addr)->sin6_addr;
      if (!IN6_IS_ADDR_LINKLOCAL(&v6)) addresses.push_back(spelling(family, &v6));
    }
  }
  return addresses;
}

std::string page_url(const std::string& address, int port) {
  const bool v6 = address.find(':') != std::string::npos;
  return "http://" + (v6 ? "[" + address + "]" : address) + ":" + std::to_string(port) + "/";
}

}  // namespace bihive::cli
