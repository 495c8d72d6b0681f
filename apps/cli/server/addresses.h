// Numeric network addresses, and the addresses of this machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"

namespace bihive::cli {

/// An IPv4 or IPv6 address in the only spelling that all functions here use ("::1" for "0:0::1"); nothing for any other
/// text.
std::optional<std::string> usual_spelling(const std::string& address);
/// The same for an option's text; an error says the expected value.
Result<std::string> address_from(const std::string& text);

/// 127.x.y.z or ::1: only this machine reaches it.
bool is_loopback(const std::string& address);
/// 0.0.0.0 or ::, every address of this machine.
bool is_every_address(const std::string& address);

/// The addresses of this machine's active network interfaces: IPv4, and IPv6 if `with_ipv6` (without addresses that
/// hold on one link only). Loopback is left out.
std::vector<std::string> own_addresses(bool with_ipv6);

/// "http://ADDRESS:PORT/".
std::string page_url(const std::string& address, int port);

}  // namespace bihive::cli
