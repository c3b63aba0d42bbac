#include "rayspace/file/file_reference.hpp"

#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace rs {
namespace {

TEST(FileReference, SpellingsOfOtherMachinesAreResolved) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(std::filesystem::create_directory(folder / "Sub"));
    const auto file = folder / "Sub" / "my t\xC3\xBC.png";
    ASSERT_TRUE(write_file(file, std::string("x")));
    for (const char* reference :
         {"Sub/my t\xC3\xBC.png", "Sub/my%20t%C3%BC.png", "Sub\\my t\xC3\xBC.png", ".\\Sub\\my%20t%c3%bc.png",
          "file:Sub/my t\xC3\xBC.png", "sub/MY T\xC3\xBC.PNG", "./../"}) {
        const auto found = resolve_reference(reference, folder.path());
        ASSERT_TRUE(found) << reference;
        if (std::string(reference) == "./../") continue;
        EXPECT_EQ(*found, file) << reference;
    }
    // Ends that exist in the folder stand for absolute paths of another machine.
    for (const char* reference :
         {"C:\\Users\\a\\my t\xC3\xBC.png", "/home/a/my%20t\xC3\xBC.png", "file:///D:/my t\xC3\xBC.png"}) {
        EXPECT_EQ(resolve_reference(reference, folder / "Sub"), file) << reference;
    }
    ASSERT_TRUE(write_file(folder / "my t\xC3\xBC.png", std::string("x")));
    for (const char* reference : {"C:\\a\\Sub\\my%20t\xC3\xBC.png", "/home/a/Sub/my t\xC3\xBC.png"}) {
        EXPECT_EQ(resolve_reference(reference, folder.path()), file) << reference;
    }
}

TEST(FileReference, ExactNamesTakePrecedenceAndMissingOnesKeepTheirName) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a%20b", "a b", "A B"}) ASSERT_TRUE(write_file(folder / name, std::string("x")));
    EXPECT_EQ(resolve_reference("a%20b", folder.path()), folder / "a%20b");
    EXPECT_EQ(resolve_reference("A%20B", folder.path()), folder / "A B");
    EXPECT_EQ(resolve_reference("none%2E", folder.path()), folder / "none.");
    for (const char* reference : {"", "http://host/a b", "urn:web3d:a", "data:image/png;base64,AA", "a%00"}) {
        EXPECT_FALSE(resolve_reference(reference, folder.path())) << reference;
    }
}

}  // namespace
}  // namespace rs
