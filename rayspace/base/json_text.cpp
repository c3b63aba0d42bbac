#include "rayspace/base/json_text.hpp"

#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace rs {
namespace {

using nlohmann::json;

constexpr int kMaxNesting = 64;

struct SyntaxError {
    std::string why;
};

// SAX observer that detects input accepted by nlohmann::json: deeply nested brackets, and repeated keys, of which it
// keeps the last.
class SyntaxObserver {
public:
    void see(int depth, json::parse_event_t event, const json& parsed) {
        using Event = json::parse_event_t;
        const bool opens = event == Event::object_start || event == Event::array_start;
        if (opens && depth >= kMaxNesting) {
            throw SyntaxError{"nests brackets more than " + std::to_string(kMaxNesting) + " deep; flatten it"};
        }
        if (event == Event::object_start) open_.emplace_back();
        if (event == Event::object_end) open_.pop_back();
        if (event != Event::key || open_.back().insert(parsed.get<std::string>()).second) return;
        throw SyntaxError{"the key \"" + printable(parsed.get<std::string>()) +
                          "\" is there twice in one object; keep one of them"};
    }

private:
    std::vector<std::set<std::string>> open_;  // keys so far of each open object
};

}  // namespace

Result<json> parse_json(std::string_view text, const std::string& where) {
    SyntaxObserver watch;
    try {
        return json::parse(text, [&](int depth, json::parse_event_t event, const json& parsed) {
            watch.see(depth, event, parsed);
            return true;
        });
    } catch (const SyntaxError& refused) {
        return Error{where + ": " + refused.why};
    } catch (const json::parse_error& error) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
        return Error{where + ": is not valid JSON at line " + std::to_string(1 + std::count(text.begin(), end, '\n')) +
                     "; correct it there (NaN and Infinity are not JSON)"};
    } catch (const json::exception&) {
        return Error{where + ": holds a number that is out of range; correct it"};
    }
}

}  // namespace rs
