#include "rayspace/image_io/backend/file_checks.hpp"

#include "rayspace/base/conventions.hpp"

#include <array>
#include <cstdint>
#include <fstream>

namespace rs::image_io {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kMultiPart = 0x1000;  // bit of the version field
constexpr std::size_t kLongestName = 255;

class HeaderReader {
public:
    HeaderReader(const std::string& path, int max_side_px)
        : path_(path), max_side_px_(max_side_px), stream_(path, std::ios::binary) {
        stream_.seekg(0, std::ios::end);
        size_ = static_cast<std::int64_t>(stream_.tellg());
        stream_.seekg(0);
    }

    Status check() {
        std::uint32_t version = 0;
        if (number() != kMagic || !stream_) return {};
        version = number();
        do {
            bool any = false;
            for (std::string name = text(); !name.empty(); name = text()) {
                any = true;
                RS_TRY(attribute());
            }
            if (!stream_) return cut_short();
            if (!any) break;  // the end of all parts' headers
        } while ((version & kMultiPart) != 0);
        return {};
    }

private:
    [[nodiscard]] Error cut_short() const {
        return Error{path_ + ": is damaged or cut short: the file ends inside the header; copy it again"};
    }
    [[nodiscard]] std::int64_t left() { return size_ - static_cast<std::int64_t>(stream_.tellg()); }

    std::uint32_t number() {
        std::array<char, 4> bytes{};
        stream_.read(bytes.data(), bytes.size());
        std::uint32_t value = 0;
        for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[i]);
        return value;
    }

    // Reads a zero-terminated text; empty at the end of the file, too. OpenEXR rejects texts that are too long.
    std::string text() {
        std::string read;
        for (char c = 0; read.size() <= kLongestName && stream_.get(c) && c != 0;) read += c;
        return read;
    }

    Status attribute() {
        const std::string type = text();
        const auto size = std::int64_t{number()};
        if (!stream_ || size > left()) return cut_short();
        const std::int64_t end = static_cast<std::int64_t>(stream_.tellg()) + size;
        if (type == "stringvector") {
            while (static_cast<std::int64_t>(stream_.tellg()) + 4 <= end) {
                const auto length = std::int64_t{number()};
                if (static_cast<std::int64_t>(stream_.tellg()) + length > end) return cut_short();
                stream_.seekg(length, std::ios::cur);
            }
        } else if (type == "preview" && size >= 8) {
            const std::uint64_t width = number();
            const std::uint64_t height = number();
            if (width > static_cast<std::uint64_t>(max_side_px_) || height > static_cast<std::uint64_t>(max_side_px_) ||
                4 * width * height > static_cast<std::uint64_t>(size)) {
                return cut_short();
            }
        } else if (type == "box2i" && size == 16) {
            std::array<std::int64_t, 4> corner{};  // x min, y min, x max, y max
            for (std::int64_t& c : corner) c = static_cast<std::int32_t>(number());
            const std::int64_t width = corner[2] - corner[0] + 1;
            const std::int64_t height = corner[3] - corner[1] + 1;
            if (width < 1 || height < 1 || width > max_side_px_ || height > max_side_px_) {
                return Error{path_ + ": claims " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels; each side must be 1.." + std::to_string(max_side_px_)};
            }
        }
        stream_.seekg(end);
        return {};
    }

    const std::string& path_;
    int max_side_px_;
    std::ifstream stream_;
    std::int64_t size_ = 0;
};

}  // namespace

Status check_exr_header(const std::string& path, int max_side_px) {
    return HeaderReader(path, max_side_px).check();
}

}  // namespace rs::image_io
