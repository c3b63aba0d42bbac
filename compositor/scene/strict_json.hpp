#pragma once
// Reads JSON that must be exactly as documented: every value is checked where it is taken, and a key that nobody took
// is an error. Private to the scene file's reader; errors travel as the exception MalformedJson up to its one catch.

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <set>
#include <string>

namespace rs::compositor {

struct MalformedJson {
    std::string message;  // "FILE: KEY: what is wrong; what to do"
};

nlohmann::json parse_json_text(const std::string& text, const std::string& file);

// One value and how it is reached, such as "nodes[2].box".
class JsonValue {
public:
    JsonValue(const nlohmann::json& value, std::string file, std::string key);

    [[nodiscard]] MalformedJson wrong(const std::string& what) const;
    [[nodiscard]] double number(double lowest, double highest) const;
    [[nodiscard]] int whole_number(int lowest, int highest) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;  // not empty, without zero characters
    [[nodiscard]] glm::dvec3 triple(double lowest, double highest) const;
    [[nodiscard]] glm::dvec3 direction() const;  // three numbers, not all 0; given back with unit length
    // Refuses what is no list, or one of another length.
    std::size_t list_size(std::size_t least, std::size_t most) const;
    [[nodiscard]] JsonValue item(std::size_t i) const;

protected:
    [[nodiscard]] const nlohmann::json& json() const { return *value_; }
    [[nodiscard]] JsonValue child(const std::string& name) const;

private:
    const nlohmann::json* value_;
    std::string file_;
    std::string key_;
};

class JsonObject : public JsonValue {
public:
    explicit JsonObject(const JsonValue& value);

    [[nodiscard]] bool has(const std::string& name) const;
    // The value of a key that is there (`has`) or must be.
    JsonValue take(const std::string& name);
    // To be called last: fails on the first key that was not taken, and lists those that could have been.
    void expect_all_taken() const;

private:
    std::set<std::string> taken_;
    mutable std::set<std::string> asked_;
};

}  // namespace rs::compositor
