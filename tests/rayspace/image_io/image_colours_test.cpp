// Images with other colour spaces than sRGB.

#include "rayspace/image/linear_light.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/camera_jpeg.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <lcms2.h>
#include <zlib.h>
#include <glm/glm.hpp>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>

namespace {

using namespace rs;

enum class Primaries { srgb, display_p3 };

std::string icc_of(Primaries primaries) {
    const cmsCIExyY d65{0.3127, 0.3290, 1};
    const cmsCIExyYTRIPLE srgb{{0.640, 0.330, 1}, {0.300, 0.600, 1}, {0.150, 0.060, 1}};
    const cmsCIExyYTRIPLE p3{{0.680, 0.320, 1}, {0.265, 0.690, 1}, {0.150, 0.060, 1}};
    const cmsFloat64Number curve[5] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
    cmsToneCurve* const tone = cmsBuildParametricToneCurve(nullptr, 4, curve);
    cmsToneCurve* const tones[3] = {tone, tone, tone};
    const cmsHPROFILE profile = cmsCreateRGBProfile(&d65, primaries == Primaries::srgb ? &srgb : &p3, tones);
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::string icc(size, 0);
    cmsSaveProfileToMem(profile, icc.data(), &size);
    cmsCloseProfile(profile);
    cmsFreeToneCurve(tone);
    return icc;
}

// Converts Display P3 codes to sRGB: primaries of SMPTE EG 432-1 to those of IEC 61966-2-1, both with white D65.
Rgba8 srgb_of_p3(const Rgba8& p3) {
    const glm::dmat3 columns(1.2249401, -0.0420569, -0.0196376,  //
                             -0.2249402, 1.0420571, -0.0786507,  //
                             0, 0, 1.0982884);
    const glm::dvec3 light =
        columns * glm::dvec3(linear_from_srgb8(p3.r), linear_from_srgb8(p3.g), linear_from_srgb8(p3.b));
    const auto code = [](double v) { return srgb8_from_linear(static_cast<float>(v)); };
    return {code(light.x), code(light.y), code(light.z), 255};
}

void expect_near(const Rgba8& a, const Rgba8& b, int codes) {
    EXPECT_NEAR(a.r, b.r, codes);
    EXPECT_NEAR(a.g, b.g, codes);
    EXPECT_NEAR(a.b, b.b, codes);
}

class ImageColours : public testing::Test {
protected:
    // Reads 32 x 16 pixels of one colour from a file with this profile.
    Rgba8 read(const Rgba8& colour, const std::string& icc) {
        EXPECT_TRUE(write_jpeg(file_, Image<Rgba8>(32, 16, colour), 100).ok());
        if (!icc.empty()) test::add_profile(file_, icc);
        const Result<Image<Rgba8>> image = read_image(file_);
        EXPECT_TRUE(image.ok()) << image.error().message;
        return (*image)(20, 8);
    }
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "photo.jpg";
};

TEST_F(ImageColours, OfDisplayP3BecomeSrgb) {
    const std::string p3 = icc_of(Primaries::display_p3);
    for (const Rgba8& colour : {Rgba8{200, 150, 100, 255}, {60, 120, 90, 255}, {180, 60, 70, 255}}) {
        const Rgba8 shown = srgb_of_p3(colour);
        ASSERT_GT(std::abs(shown.r - colour.r) + std::abs(shown.g - colour.g), 8) << "a colour that tells";
        expect_near(read(colour, p3), shown, 2);
        const Result<Image<RgbaF>> light = read_image_linear(file_);
        ASSERT_TRUE(light.ok()) << light.error().message;
        EXPECT_NEAR((*light)(20, 8).r, linear_from_srgb8(shown.r), 0.01);
        EXPECT_NEAR((*light)(20, 8).b, linear_from_srgb8(shown.b), 0.01);
    }
    expect_near(read({250, 10, 20, 255}, p3), {255, 0, 0, 255}, 12);  // outside of sRGB: clipped to its gamut
    expect_near(read({128, 128, 128, 255}, p3), {128, 128, 128, 255}, 1);
}

TEST_F(ImageColours, OfSrgbStayAsTheyAre) {
    const std::string srgb = icc_of(Primaries::srgb);
    for (const Rgba8& colour : {Rgba8{200, 150, 100, 255}, {3, 250, 120, 255}}) {
        EXPECT_EQ(read(colour, srgb), read(colour, ""));
    }
}

TEST_F(ImageColours, StayWhereTheProfileIsNone) {
    const std::string p3 = icc_of(Primaries::display_p3);
    const Rgba8 colour{200, 150, 100, 255};
    for (const std::string& icc : {std::string("no profile"), p3.substr(0, p3.size() / 2), std::string(40000, 'x')}) {
        EXPECT_EQ(read(colour, icc), read(colour, "")) << icc.size();
    }
}

// OpenImageIO 2.4 reads at any offset stated in a profile's tag table.
TEST_F(ImageColours, OfADamagedProfileAreRefusedOrRead) {
    std::mt19937 random(5);
    const std::string p3 = icc_of(Primaries::display_p3);
    constexpr std::size_t kTable = 128;
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string damaged = p3;
        for (int k = 0; k < 4; ++k) {
            const std::size_t at = i % 2 == 0 ? random() % damaged.size() : kTable + random() % 120;
            damaged[at] = static_cast<char>(random());
        }
        ASSERT_TRUE(write_jpeg(file_, Image<Rgba8>(32, 16, Rgba8{200, 150, 100, 255}), 100).ok());
        test::add_profile(file_, damaged);
        const Result<Image<Rgba8>> image = read_image(file_);
        if (image) continue;
        ++refused;
        EXPECT_NE(image.error().message.find("photo.jpg: its colour profile is damaged"), std::string::npos)
            << image.error().message;
        EXPECT_FALSE(read_image_info(file_).ok());
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 390);
}

// A profile with one tag at offset `at`, which is valid at 144.
std::string profile_of_a_tag(unsigned char at) {
    std::string profile(164, '\0');
    profile[3] = static_cast<char>(164);
    profile.replace(36, 4, "acsp");
    profile[131] = 1;
    profile.replace(132, 4, "desc");
    profile[139] = static_cast<char>(at);
    profile[143] = 20;
    profile.replace(144, 4, "desc");
    return profile;
}

std::string big_endian(std::uint32_t n) {
    return test::bytes({static_cast<int>(n >> 24U), static_cast<int>(n >> 16U & 255U), static_cast<int>(n >> 8U & 255U),
                        static_cast<int>(n & 255U)});
}

std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string checked = type + data;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    return big_endian(static_cast<std::uint32_t>(data.size())) + checked + big_endian(static_cast<std::uint32_t>(sum));
}

std::string deflated(const std::string& data) {
    std::string packed(data.size() + 100, '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(data.data()), data.size());
    packed.resize(size);
    return packed;
}

// Files that consist only of a header and a profile.
std::map<std::string, std::string> files_with(const std::string& profile) {
    std::map<std::string, std::string> files;
    const std::string png =
        std::string("\x89PNG\r\n\x1a\n") + png_chunk("IHDR", std::string("\0\0\0\4\0\0\0\4\10\2\0\0\0", 13));
    const std::string iccp = png_chunk("iCCP", std::string("p\0\0", 3) + deflated(profile));
    const std::string rest = png_chunk("IDAT", deflated(std::string(52, '\0'))) + png_chunk("IEND", "");
    files["png"] = png + iccp + rest;
    files["png with more behind the profile"] =
        png + png_chunk("iCCP", std::string("p\0\0", 3) + deflated(profile + "more")) + rest;
    files["png of two"] = png + png_chunk("iCCP", "p") + iccp + rest;
    const std::string part = "ICC_PROFILE" + test::bytes({0, 1, 1}) + profile;
    const std::string app2 = test::bytes({0xFF, 0xE2, 0, static_cast<int>(part.size()) + 2}) + part;
    const std::string half = "ICC_PROFILE" + test::bytes({0, 2, 2}) + profile.substr(80);
    const std::string first = "ICC_PROFILE" + test::bytes({0, 1, 2}) + profile.substr(0, 80);
    for (const auto& [name, between] :
         std::map<std::string, std::string>{{"jpeg", ""},
                                            {"jpeg with a stray byte", "x"},
                                            {"jpeg with a marker alone", "\xFF\x01\xFF\xD0"},
                                            {"jpeg with zeros", std::string("\0\xFF\0", 3)},
                                            {"jpeg with filling", "\xFF\xFF"}}) {
        files[name] = "\xFF\xD8" + between + app2 + "\xFF\xD9";
    }
    files["jpeg of two parts"] = "\xFF\xD8" + test::bytes({0xFF, 0xE2, 0, static_cast<int>(half.size()) + 2}) + half +
                                 test::bytes({0xFF, 0xE2, 0, static_cast<int>(first.size()) + 2}) + first + "\xFF\xD9";
    const auto size = static_cast<int>(profile.size());
    files["tiff"] = std::string("II*\0\10\0\0\0\1\0", 10) +
                    test::bytes({0x73, 0x87, 7, 0, size, 0, 0, 0, 26, 0, 0, 0}) + std::string(4, '\0') + profile;
    files["big tiff"] = std::string("MM\0\53\0\10\0\0\0\0\0\0\0\0\0\20\0\0\0\0\0\0\0\1", 24) +
                        test::bytes({0x87, 0x73, 0, 1, 0, 0, 0, 0, 0, 0, 0, size, 0, 0, 0, 0, 0, 0, 0, 44}) + profile;
    files["webp"] = "RIFF....WEBPVP8X" + std::string("\12\0\0\0", 4) + std::string(10, 'x') + "ICCP" +
                    test::bytes({size, 0, 0, 0}) + profile;
    return files;
}

TEST_F(ImageColours, OfDamagedProfilesAreFoundInEveryKindOfFile) {
    const auto refuses = [&](const std::string& file) {
        std::ofstream(file_, std::ios::binary) << file;
        const Result<ImageInfo> info = read_image_info(file_);
        return !info.ok() && info.error().message.find("its colour profile is damaged") != std::string::npos;
    };
    for (const auto& [name, file] : files_with(profile_of_a_tag(144))) EXPECT_FALSE(refuses(file)) << name;
    for (const auto& [name, file] : files_with(profile_of_a_tag(145))) EXPECT_TRUE(refuses(file)) << name;
    std::string other = files_with(profile_of_a_tag(144)).at("tiff");
    other[12] = 3;  // libtiff would convert two-byte numbers to bytes
    EXPECT_TRUE(refuses(other));
    for (const std::string& kind : {std::string("\0\0\1\0icon", 8), std::string("8BPS")}) {
        std::ofstream(file_, std::ios::binary) << kind;
        const Result<ImageInfo> info = read_image_info(file_);
        ASSERT_FALSE(info.ok());
        EXPECT_NE(info.error().message.find("are not read; convert it"), std::string::npos) << info.error().message;
    }
}

TEST_F(ImageColours, BeyondSrgbAreNoNegativeLight) {
    read({250, 10, 20, 255}, icc_of(Primaries::display_p3));
    const Result<Image<RgbaF>> light = read_image_linear(file_);
    ASSERT_TRUE(light.ok()) << light.error().message;
    for (const RgbaF& p : light->pixels()) {
        ASSERT_TRUE(p.r <= 1 && p.g >= 0 && p.b >= 0) << p.r << " " << p.g << " " << p.b;
    }
}

}  // namespace
