#pragma once
// Strict reading of a recipe's JSON (rayspace/base/json_text.hpp): every key must be known, of the right type and in
// range. The first error is kept, with the recipe's file and the place in it ("camera.views"); later reads then change
// nothing.

#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>

namespace rs::capture {

// Collects what went wrong over one recipe.
struct RecipeErrors {
    std::string file;
    std::optional<Error> first;

    void add(const std::string& place, const std::string& problem) {
        if (!first) first = Error{file + ": " + place + ": " + problem};
    }
};

// Reads one JSON object. Values whose key is absent keep what they were. Call finish() after the last read: it reports
// keys that nobody asked for.
class RecipeReader {
public:
    static constexpr double kHuge = 1e9;

    RecipeReader(const nlohmann::json& object, std::string place, RecipeErrors& errors);

    [[nodiscard]] bool has(const char* key) const;
    void read(const char* key, double& value, double low = -kHuge, double high = kHuge);
    void read(const char* key, float& value, double low = -kHuge, double high = kHuge);
    void read(const char* key, int& value, int low, int high);
    void read(const char* key, std::uint64_t& value);
    void read(const char* key, bool& value);
    void read(const char* key, std::string& value);
    // Three numbers; one number stands for three equal ones.
    void read(const char* key, glm::vec3& value, double low = -kHuge, double high = kHuge);
    // The value as it is, or null where the key is absent.
    const nlohmann::json* child(const char* key);
    void finish();

    void complain(const std::string& problem) { errors_.add(place_, problem); }
    void complain(const char* key, const std::string& problem) { errors_.add(place_of(key), problem); }
    [[nodiscard]] std::string place_of(const std::string& key) const;
    [[nodiscard]] RecipeErrors& errors() { return errors_; }

private:
    const nlohmann::json& object_;
    std::string place_;
    RecipeErrors& errors_;
    std::set<std::string> known_;
};

}  // namespace rs::capture
