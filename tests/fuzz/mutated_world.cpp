#include "tests/fuzz/mutated_world.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace rs::fuzz {
namespace {

constexpr std::array kStrange = {"-1",
                                 "0",
                                 "1e38",
                                 "-1e38",
                                 "1e-40",
                                 "nan",
                                 "4294967295",
                                 "-2147483648",
                                 "99999999",
                                 "0x80000000",
                                 "{",
                                 "}",
                                 "[",
                                 "]",
                                 "\"",
                                 "NULL",
                                 "TRUE",
                                 "USE A",
                                 "DEF A",
                                 "IS x",
                                 "Group {",
                                 "Shape { geometry",
                                 "children [",
                                 "PROTO P [ ] {",
                                 "Inline { url \"input.wrl\" }",
                                 "IndexedFaceSet {",
                                 "coordIndex [ 0 1 2 ]",
                                 "Extrusion {",
                                 "spine [ ]",
                                 "creaseAngle",
                                 "ROUTE a.b TO c.d",
                                 "Script {",
                                 "#",
                                 "1 1 1",
                                 "3.14159",
                                 "Transform { scale 0 0 0 }"};

constexpr std::array kNumbers = {"-1",   "0",     "1",     "2",     "3",  "7",   "100",
                                 "1e38", "-1e38", "1e-30", "99999", "-2", "0.5", "2147483647"};

// Splits into words, brackets and the space between them, which can be joined again.
std::vector<std::string> pieces_of(const std::string& world) {
    std::vector<std::string> pieces;
    for (std::size_t i = 0; i < world.size();) {
        const auto kind = [&](std::size_t at) {
            const auto c = static_cast<unsigned char>(world[at]);
            return std::isspace(c) != 0 || c == ','                           ? 0
                   : std::string("{}[]").find(world[at]) != std::string::npos ? 1
                                                                              : 2;
        };
        std::size_t end = i + 1;
        while (kind(i) != 1 && end < world.size() && kind(end) == kind(i)) ++end;
        pieces.push_back(world.substr(i, end - i));
        i = end;
    }
    return pieces;
}

std::string joined(const std::vector<std::string>& pieces) {
    std::string world;
    for (const std::string& piece : pieces) world += piece;
    return world;
}

bool is_number(const std::string& piece) {
    const char first = piece[0];
    return std::isdigit(static_cast<unsigned char>(first)) != 0 || ((first == '-' || first == '.') && piece.size() > 1);
}

// The index after the bracket that closes the one at `at`.
std::size_t after_close(const std::vector<std::string>& pieces, std::size_t at) {
    int open = 0;
    for (std::size_t i = at; i < pieces.size(); ++i) {
        if (pieces[i] == "{" || pieces[i] == "[") ++open;
        if ((pieces[i] == "}" || pieces[i] == "]") && --open == 0) return i + 1;
    }
    return pieces.size();
}

// Changes that keep the syntax: numbers, whole lists and node bodies.
void change_gently(std::vector<std::string>& pieces, std::size_t first, std::mt19937_64& random) {
    const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    const auto find = [&](auto&& wanted) {
        for (int trial = 0; trial < 200; ++trial) {
            const std::size_t at = first + below(pieces.size() - first);
            if (wanted(pieces[at])) return at;
        }
        return first;
    };
    const auto is_open = [](const std::string& piece) { return piece == "{" || piece == "["; };
    const std::size_t number = find(is_number);
    const std::size_t opened = find(is_open);
    const std::size_t closed = after_close(pieces, opened);
    const auto at = [&](std::size_t i) { return pieces.begin() + static_cast<std::ptrdiff_t>(i); };
    switch (below(5)) {
        case 0:
            pieces[number] = kNumbers[below(kNumbers.size())];
            break;
        case 1:
            std::swap(pieces[number], pieces[find(is_number)]);
            break;
        case 2:
            if (closed > opened + 2) pieces.erase(at(opened + 1), at(closed - 1));
            break;
        case 3: {
            // Insert a whole node into a list of nodes.
            const std::size_t list = find([](const std::string& piece) { return piece == "["; });
            if (opened < 2 || pieces[opened] != "{" || list < 2 || pieces[list - 2] != "children") break;
            const std::vector<std::string> node(at(opened - 2), at(closed));
            pieces.insert(at(list + 1), node.begin(), node.end());
            break;
        }
        default: {
            // Names and types from another place.
            const auto is_word = [&](const std::string& piece) {
                return std::isalpha(static_cast<unsigned char>(piece[0])) != 0;
            };
            pieces[find(is_word)] = pieces[find(is_word)];
            break;
        }
    }
}

}  // namespace

std::string mutated_world(const std::vector<std::string>& worlds, std::mt19937_64& random) {
    const auto below = [&](std::size_t count) {
        return static_cast<std::size_t>(random() % std::max<std::size_t>(count, 1));
    };
    std::vector<std::string> pieces = pieces_of(worlds[below(worlds.size())]);
    const std::vector<std::string> others = pieces_of(worlds[below(worlds.size())]);
    // Most mutations keep the header: the first line's words.
    const std::size_t first = below(20) == 0 ? 0 : std::min<std::size_t>(6, pieces.size());
    if (below(2) == 0 && pieces.size() > first + 8) {
        for (std::size_t count = 1 + below(6); count > 0; --count) change_gently(pieces, first, random);
        return joined(pieces);
    }
    for (std::size_t count = 1 + below(3); count > 0; --count) {
        if (pieces.size() <= first + 1) break;
        const std::size_t at = first + below(pieces.size() - first);
        const std::size_t other = first + below(pieces.size() - first);
        const auto place = pieces.begin() + static_cast<std::ptrdiff_t>(at);
        const auto many = static_cast<std::ptrdiff_t>(std::min(1 + below(30), pieces.size() - at));
        switch (below(9)) {
            case 0:
                pieces.erase(place, place + many);
                break;
            case 1:
                std::swap(pieces[at], pieces[other]);
                break;
            case 2:
                pieces[at] = kStrange[below(kStrange.size())];
                break;
            case 3:
                pieces.insert(place, kStrange[below(kStrange.size())] + std::string(" "));
                break;
            case 4: {
                const std::vector<std::string> copy(place, place + many);
                pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(other), copy.begin(), copy.end());
                break;
            }
            case 5: {
                const std::size_t from = below(others.size());
                const std::size_t taken = std::min(1 + below(60), others.size() - from);
                const auto begin = others.begin() + static_cast<std::ptrdiff_t>(from);
                pieces.insert(place, begin, begin + static_cast<std::ptrdiff_t>(taken));
                break;
            }
            case 6:
                pieces.resize(at + 1);
                break;
            case 7:
                for (char& c : pieces[at]) {
                    if (below(3) == 0) c = static_cast<char>(random());
                }
                break;
            default:
                pieces[at] = pieces[other];
                break;
        }
    }
    return joined(pieces);
}

}  // namespace rs::fuzz
