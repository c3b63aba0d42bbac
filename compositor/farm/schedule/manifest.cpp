#include "compositor/farm/schedule/manifest.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace rs::farm {
namespace {

Error failure_of(const std::filesystem::path& path, const char* what) {
    return Error{path.string() + ": " + what + ": " + std::strerror(errno)};
}

Status lock(int descriptor, const std::filesystem::path& path, double patience_s) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
    while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK && errno != EINTR) return failure_of(path, "cannot be locked");
        if (std::chrono::steady_clock::now() > end) {
            return Error{path.string() + ": another rs-farm is at work here; wait for it or write elsewhere"};
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return {};
}

Status write_all(int descriptor, std::string_view text, const std::filesystem::path& path) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return failure_of(path, "cannot be written");
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
}

}  // namespace

Result<std::map<std::string, Outcome>> parse_manifest(std::string_view text, const std::string& where) {
    std::map<std::string, Outcome> outcomes;
    for (int line = 1;; ++line) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return outcomes;
        const std::string here = where + ": line " + std::to_string(line);
        const auto json = parse_json(text.substr(0, end), here);
        if (!json) return json.error();
        text.remove_prefix(end + 1);
        if (!json->is_object() || !json->contains("item") || !json->at("item").is_string()) {
            return Error{here + ": names no item; remove the line"};
        }
        Result<Outcome> outcome = outcome_from(*json);
        if (!outcome) return Error{here + ": " + outcome.error().message + "; remove the line"};
        outcomes[json->at("item")] = std::move(*outcome);
    }
}

Result<Manifest> Manifest::open(const std::filesystem::path& path, double patience_s) {
    Manifest manifest;
    manifest.path_ = path;
    manifest.descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOCTTY, 0666);
    if (manifest.descriptor_ < 0) return failure_of(path, "cannot be opened");
    if (Status locked = lock(manifest.descriptor_, path, patience_s); !locked) return locked.error();
    const Result<std::vector<std::byte>> bytes = read_file(path, kManifestCap_bytes);
    if (!bytes) return bytes.error();
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    Result<std::map<std::string, Outcome>> outcomes = parse_manifest(text, path.string());
    if (!outcomes) return outcomes.error();
    manifest.outcomes_ = std::move(*outcomes);
    const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
    if (::ftruncate(manifest.descriptor_, static_cast<off_t>(whole)) != 0 ||
        ::lseek(manifest.descriptor_, 0, SEEK_END) < 0) {
        return failure_of(path, "cannot be written");
    }
    return manifest;
}

Manifest::Manifest(Manifest&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      outcomes_(std::move(other.outcomes_)),
      pending_(std::move(other.pending_)) {}

Manifest& Manifest::operator=(Manifest&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(outcomes_, other.outcomes_);
    std::swap(pending_, other.pending_);
    return *this;
}

Manifest::~Manifest() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

const Outcome* Manifest::find(const std::string& item) const {
    const auto found = outcomes_.find(item);
    return found == outcomes_.end() ? nullptr : &found->second;
}

void Manifest::add(const std::string& item, const Outcome& outcome, const nlohmann::json& more) {
    nlohmann::json line = to_json(outcome);
    line["item"] = item;
    line.update(more);
    for (const char* key : {"staged", "recorded"}) line.erase(key);
    pending_ += line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

Status Manifest::commit() {
    if (pending_.empty()) return {};
    if (Status written = write_all(descriptor_, pending_, path_); !written) return written;
    pending_.clear();
    if (::fdatasync(descriptor_) != 0) return failure_of(path_, "cannot be written");
    return {};
}

}  // namespace rs::farm
