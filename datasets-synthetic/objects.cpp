#include "datasets-synthetic/objects.hpp"

#include "datasets-synthetic/objects/generators.hpp"

namespace rs::synthetic {
namespace {

struct Entry {
    const char* name;
    Result<capture::Scene> (*generate)(const nlohmann::json& parameters, std::uint64_t seed);
};

constexpr Entry kObjects[] = {
    {"vase", generate_vase},       {"flower", generate_flower}, {"doll", generate_doll},   {"lamp", generate_lamp},
    {"lattice", generate_lattice}, {"blocks", generate_blocks}, {"phone", generate_phone},
};

}  // namespace

std::vector<std::string> object_names() {
    std::vector<std::string> names;
    for (const Entry& entry : kObjects) names.emplace_back(entry.name);
    return names;
}

Result<capture::Scene> generate(const std::string& name, const nlohmann::json& parameters, std::uint64_t seed) {
    std::string known;
    for (const Entry& entry : kObjects) {
        if (name == entry.name) return entry.generate(parameters, seed);
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    return Error{"no synthetic object named \"" + name.substr(0, 40) + "\"; there are " + known};
}

}  // namespace rs::synthetic
