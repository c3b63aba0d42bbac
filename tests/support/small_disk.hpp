#pragma once
// A small tmpfs is_mounted on a folder, for tests of a full disk. Requires the privilege to mount.

#include <sys/mount.h>

#include <filesystem>
#include <string>

namespace rs::test {

class SmallDisk {
public:
    explicit SmallDisk(const std::filesystem::path& folder, int size_kib = 64)
        : folder_(folder),
          mounted_(::mount("tmpfs", folder.c_str(), "tmpfs", 0, ("size=" + std::to_string(size_kib) + "k").c_str()) ==
                   0) {}
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk() {
        if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
    }
    /// False if mounting is not permitted; the test is then skipped.
    [[nodiscard]] bool mounted() const { return mounted_; }

private:
    std::filesystem::path folder_;
    bool mounted_;
};

}  // namespace rs::test
