#pragma once
// Reads JSON that must be exactly as documented, for all files in JSON that people write: every value is checked where
// it is taken, and a key that nobody took is an error. Errors travel as the exception MalformedJson up to read_json().
// No two threads may use one JsonObject at a time.

#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rs {

struct MalformedJson {
    std::string message;  // "FILE: KEY: what is wrong; what to do", printable
};

// As parse_json() of json_text.hpp, but throws MalformedJson.
nlohmann::json parse_json_text(std::string_view text, const std::string& file);

// One value, the file's name and how the value is reached there, such as "nodes[2].box". Refers to `value`.
class JsonValue {
public:
    JsonValue(const nlohmann::json& value, std::string file, std::string key);

    [[nodiscard]] MalformedJson wrong(const std::string& what) const;
    [[nodiscard]] const nlohmann::json& json() const { return *value_; }
    [[nodiscard]] double number(double lowest, double highest) const;
    [[nodiscard]] int whole_number(int lowest, int highest) const;
    [[nodiscard]] std::uint64_t unsigned_number() const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;           // not empty, without zero characters
    [[nodiscard]] std::string text_or_empty() const;  // without zero characters
    // The index of the text in `words`.
    [[nodiscard]] std::size_t one_of(const std::vector<std::string>& words) const;
    [[nodiscard]] glm::dvec3 triple(double lowest, double highest) const;
    [[nodiscard]] glm::dvec3 direction() const;  // three numbers, not all 0; given back with unit length
    // Refuses what is no list, or one of another length.
    std::size_t list_size(std::size_t least, std::size_t most) const;
    [[nodiscard]] JsonValue item(std::size_t i) const;

protected:
    [[nodiscard]] JsonValue child(const std::string& name) const;

private:
    const nlohmann::json* value_;
    std::string file_;
    std::string key_;
};

class JsonObject : public JsonValue {
public:
    static constexpr double kMost = 1e9;

    explicit JsonObject(const JsonValue& value);

    [[nodiscard]] bool has(const std::string& name) const;
    // The value of a key that is there (`has`) or must be.
    JsonValue take(const std::string& name);
    // The same for a key that may be missing.
    std::optional<JsonValue> find(const std::string& name);
    // Likewise; of a key that is missing `value` stays as it is.
    void read(const std::string& name, double& value, double lowest = -kMost, double highest = kMost);
    void read(const std::string& name, float& value, double lowest = -kMost, double highest = kMost);
    void read(const std::string& name, int& value, int lowest, int highest);
    void read(const std::string& name, bool& value);
    void read(const std::string& name, std::string& value);  // may be empty
    // Three numbers; one number stands for three equal ones.
    void read(const std::string& name, glm::vec3& value, double lowest = -kMost, double highest = kMost);
    // All keys that were not taken, which this takes.
    [[nodiscard]] nlohmann::json take_rest();
    // To be called last: fails on the first key that was not taken, and lists those that could have been.
    void expect_all_taken() const;

private:
    std::set<std::string> taken_;
    mutable std::set<std::string> known_;
};

// What `read` makes of the object that is the whole text; it must take all of its keys. Errors are those of
// parse_json() and what `read` throws as MalformedJson.
template <class Read>
auto read_json(std::string_view text, const std::string& file, const Read& read)
    -> Result<decltype(read(std::declval<JsonObject&>()))> {
    try {
        const nlohmann::json json = parse_json_text(text, file);
        JsonObject top(JsonValue(json, file, ""));
        auto made = read(top);
        top.expect_all_taken();
        return made;
    } catch (const MalformedJson& malformed) {
        return Error{malformed.message};
    }
}

}  // namespace rs
