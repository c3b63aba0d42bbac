#pragma once
// gzip (RFC 1952) in memory. Pure; thread-safe.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace rs::compositor {

bool is_gzip(std::span<const std::byte> bytes);

// All members, one after the other. Refuses what is damaged or unpacks to more than `cap_bytes`; `file` names it.
Result<std::string> gunzip(std::span<const std::byte> bytes, std::uint64_t cap_bytes, const std::string& file);

}  // namespace rs::compositor
