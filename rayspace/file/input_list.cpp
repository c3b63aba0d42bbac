#include "rayspace/file/input_list.hpp"

#include "rayspace/file/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

namespace rs {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kFirstLine = "rayspace inputs 1";

std::int64_t modified_ns(const struct stat& info) {
    return std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec;
}

bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F;
}

std::string escaped(const std::string& path) {
    std::string text;
    for (const char c : path) {
        if (!is_control(c) && c != '%') {
            text += c;
            continue;
        }
        char hexadecimal[4];
        std::snprintf(hexadecimal, sizeof hexadecimal, "%%%02x", static_cast<unsigned char>(c));
        text += hexadecimal;
    }
    return text;
}

// Nothing where an escape is broken, or a character is there that is always escaped.
std::optional<std::string> unescaped(std::string_view text) {
    std::string path;
    while (!text.empty()) {
        if (is_control(text.front())) return std::nullopt;
        if (text.front() != '%') {
            path += text.front();
            text.remove_prefix(1);
            continue;
        }
        unsigned byte = 0;
        if (text.size() < 3) return std::nullopt;
        const auto [end, wrong] = std::from_chars(text.data() + 1, text.data() + 3, byte, 16);
        if (wrong != std::errc{} || end != text.data() + 3 || byte == 0) return std::nullopt;
        path += static_cast<char>(byte);
        text.remove_prefix(3);
    }
    return path;
}

// A number and the space after it, taken from the front.
template <class T>
bool take(std::string_view& text, T& number, int base) {
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number, base);
    if (wrong != std::errc{} || end == text.data() + text.size() || *end != ' ') return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
    return true;
}

}  // namespace

Result<std::uint64_t> sum_of_file(const fs::path& path) {
    const Result<int> opened = open_input(path, false);
    if (!opened) return opened.error();
    constexpr std::size_t kPiece_bytes = 1 << 20;
    const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state(XXH64_createState(), &XXH64_freeState);
    XXH64_reset(state.get(), 0);
    std::vector<char> piece(kPiece_bytes);
    ssize_t read = 0;
    while ((read = ::read(*opened, piece.data(), piece.size())) != 0) {
        if (read < 0 && errno == EINTR) continue;
        if (read < 0) break;
        XXH64_update(state.get(), piece.data(), static_cast<std::size_t>(read));
    }
    const int error = errno;
    ::close(*opened);
    if (read < 0) return Error{path.string() + ": cannot be read: " + std::strerror(error)};
    return XXH64_digest(state.get());
}

Result<std::vector<InputStamp>> input_stamps() {
    std::vector<InputStamp> stamps;
    for (const fs::path& path : noted_inputs()) {
        struct stat info {};
        if (::stat(path.c_str(), &info) != 0) return Error{path.string() + ": was read and is gone; begin again"};
        const Result<std::uint64_t> sum = sum_of_file(path);
        if (!sum) return sum.error();
        stamps.push_back({path, *sum, static_cast<std::uint64_t>(info.st_size), modified_ns(info)});
    }
    std::ranges::sort(stamps, {}, &InputStamp::path);
    return stamps;
}

std::string input_list_text(const std::vector<InputStamp>& stamps) {
    std::string text = std::string(kFirstLine) + '\n';
    for (const InputStamp& stamp : stamps) {
        char numbers[96];
        std::snprintf(numbers, sizeof numbers, "%016llx %llu %lld ", static_cast<unsigned long long>(stamp.sum),
                      static_cast<unsigned long long>(stamp.bytes), static_cast<long long>(stamp.modified_ns));
        text += numbers + escaped(stamp.path.string()) + '\n';
    }
    return text;
}

Result<std::vector<InputStamp>> parse_input_list(std::string_view text, const std::string& where) {
    std::vector<InputStamp> stamps;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line == 1) {
            if (rest == kFirstLine && end != std::string_view::npos) continue;
            return Error{where + ": is no list of inputs; remove it"};
        }
        InputStamp stamp;
        const bool numbers =
            take(rest, stamp.sum, 16) && take(rest, stamp.bytes, 10) && take(rest, stamp.modified_ns, 10);
        std::optional<std::string> path = numbers ? unescaped(rest) : std::nullopt;
        if (!path || path->empty() || end == std::string_view::npos) {
            return Error{where + ": line " + std::to_string(line) + ": is no input; remove the list"};
        }
        stamp.path = std::move(*path);
        stamps.push_back(std::move(stamp));
    }
    return stamps;
}

bool are_unchanged(const std::vector<InputStamp>& stamps) {
    return std::ranges::all_of(stamps, [](const InputStamp& stamp) {
        struct stat info {};
        if (::stat(stamp.path.c_str(), &info) != 0) return false;
        if (static_cast<std::uint64_t>(info.st_size) != stamp.bytes) return false;
        if (modified_ns(info) == stamp.modified_ns) return true;
        const Result<std::uint64_t> sum = sum_of_file(stamp.path);
        return sum.ok() && *sum == stamp.sum;
    });
}

}  // namespace rs
