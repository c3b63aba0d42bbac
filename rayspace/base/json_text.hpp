#pragma once
// JSON text from outside (scenes, recipes, rigs, boards, conformance vectors): a parser with limits, and a strict
// reader for files written by users, which checks every value when it is read and rejects unknown keys. Errors of the
// reader travel as the exception MalformedJson up to read_json(). A JsonObject is not thread-safe.

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

/// Parses JSON text. Errors, which name `where` and the line: invalid JSON, brackets nested more than 64 deep, a number
/// out of range, a repeated key. Thread-safe.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& where);

/// Removes white space and rounds fractions to nine significant digits, for storage: a millionth of a pixel is far
/// below the accuracy of a calibration, and the full text of a rig is as large as an image. Keys keep their order.
/// `text` must be valid JSON.
std::string compact_json(const std::string& text);

struct MalformedJson {
    std::string message;  // "FILE: KEY: what is wrong; what to do", without control characters
};

/// As parse_json(), but throws MalformedJson.
nlohmann::json parse_json_text(std::string_view text, const std::string& file);

/// A value with the file's name and its path in the file, such as "nodes[2].box". Refers to `value`.
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
    /// The index of the text in `words`.
    [[nodiscard]] std::size_t one_of(const std::vector<std::string>& words) const;
    [[nodiscard]] glm::dvec3 triple(double lowest, double highest) const;
    [[nodiscard]] glm::dvec3 direction() const;  // three numbers, not all 0; normalised
    /// Fails unless the value is a list of `least` to `most` items.
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
    /// The value of a required key.
    JsonValue take(const std::string& name);
    /// The value of an optional key.
    std::optional<JsonValue> find(const std::string& name);
    /// Reads an optional key; `value` is unchanged if the key is missing.
    void read(const std::string& name, double& value, double lowest = -kMost, double highest = kMost);
    void read(const std::string& name, float& value, double lowest = -kMost, double highest = kMost);
    void read(const std::string& name, int& value, int lowest, int highest);
    void read(const std::string& name, bool& value);
    void read(const std::string& name, std::string& value);  // may be empty
    /// Three numbers; a single number sets all three.
    void read(const std::string& name, glm::vec3& value, double lowest = -kMost, double highest = kMost);
    /// All unread keys, which then count as read.
    [[nodiscard]] nlohmann::json take_rest();
    /// Fails on the first unread key, and lists the keys that are allowed. Must be called last.
    void expect_no_unknown_keys() const;

private:
    std::set<std::string> taken_;
    mutable std::set<std::string> known_;
};

/// Parses a JSON object and returns read(object), which must read all keys. Errors: those of parse_json(), and
/// MalformedJson thrown by `read`.
template <class Read>
auto read_json(std::string_view text, const std::string& file, const Read& read)
    -> Result<decltype(read(std::declval<JsonObject&>()))> {
    try {
        const nlohmann::json json = parse_json_text(text, file);
        JsonObject top(JsonValue(json, file, ""));
        auto made = read(top);
        top.expect_no_unknown_keys();
        return made;
    } catch (const MalformedJson& malformed) {
        return Error{malformed.message};
    }
}

}  // namespace rs
