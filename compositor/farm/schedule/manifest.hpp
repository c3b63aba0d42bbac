#pragma once
// What was made of what: a file of JSON lines beside the results, to which each run adds. The last line of an item
// counts. A line that was cut short, as the last of a run that was killed may be, is cut off.
//
//     {"item": "vase", "state": "made", "key": ..., "inputs": ..., "output": ..., "sum": ..., "seconds": ..., ...}

#include "compositor/farm/schedule/item.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace rs::farm {

inline constexpr std::uint64_t kManifestCap_bytes = std::uint64_t{1} << 30;

// The last outcome of each item. Lines that are no such thing are errors that name their number; a last line without
// an end is no line. Takes a few times the memory of the text. Pure.
Result<std::map<std::string, Outcome>> parse_manifest(std::string_view text, const std::string& where);

// Move-only; one thread.
class Manifest {
public:
    // Waits up to `patience_s` while another run holds it, then refuses. Creates it where there is none.
    static Result<Manifest> open(const std::filesystem::path& path, double patience_s);
    Manifest(Manifest&& other) noexcept;
    Manifest& operator=(Manifest&& other) noexcept;
    ~Manifest();

    // Of earlier runs; null where the item is new.
    [[nodiscard]] const Outcome* find(const std::string& item) const;
    // `more`, an object, is added to the line: who did it, where.
    void add(const std::string& item, const Outcome& outcome, const nlohmann::json& more);
    // All that was added stands on the disk afterwards.
    Status commit();

private:
    Manifest() = default;
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::map<std::string, Outcome> outcomes_;
    std::string pending_;
};

}  // namespace rs::farm
