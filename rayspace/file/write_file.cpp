#include "rayspace/file/write_file.hpp"

namespace rs {

Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    Result<StagedFile> file = StagedFile::create(path);
    if (!file) return file.error();
    if (Status status = file->write(bytes); !status) return status;
    return file->commit();
}

Status write_file(const std::filesystem::path& path, const std::string& text) {
    return write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace rs
