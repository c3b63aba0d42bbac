#pragma once
// A disk that is soon full: a small tmpfs over a folder, for tests of what happens then. Needs the right to mount.

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
    // False where this user may not mount; the test is then to be skipped.
    [[nodiscard]] bool mounted() const { return mounted_; }

private:
    std::filesystem::path folder_;
    bool mounted_;
};

}  // namespace rs::test
