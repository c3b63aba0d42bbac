#pragma once
// Result of a codec on a set at one setting, and a cache of such results of external encoders.

#include "rayspace/base/result.hpp"
#include "tests/bench/rd/object_error.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace rs::bench {

struct Coded {
    std::uint64_t bytes = 0;
    ObjectError error;
    bool has_alpha = false;  // the codec stores alpha; error.alpha_error is valid
};

/// Small text files in a folder, named after the hash of a key with everything that the result depends on: images,
/// codec, settings, version of the tool. Files that cannot be parsed are ignored.
class CodedCache {
public:
    // The folder must exist.
    explicit CodedCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
    [[nodiscard]] std::optional<Coded> find(const std::string& key) const;
    [[nodiscard]] Status store(const std::string& key, const Coded& coded) const;

private:
    [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;
    std::filesystem::path folder_;
};

}  // namespace rs::bench
