#pragma once
// What a codec made of a set at one setting, and how such answers of external encoders are kept between runs.

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
    bool has_alpha = false;  // whether the codec stores alpha, and error.alpha_error means anything
};

// Small text files in a folder, named after the hash of a key that says everything the answer depends on: images,
// codec, settings, version of the tool. A file that cannot be understood counts as not there.
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
