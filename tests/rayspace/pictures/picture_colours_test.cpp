// Pictures whose numbers are not sRGB's.

#include "rayspace/image/linear_light.hpp"
#include "rayspace/pictures/picture_io.hpp"
#include "tests/support/oriented_jpeg.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <lcms2.h>
#include <glm/glm.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
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

// What sRGB shows as these Display P3 codes do; SMPTE EG 432-1's primaries to IEC 61966-2-1's, both of white D65.
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

class PictureColours : public testing::Test {
protected:
    // 32 x 16 pixels of one colour, as the file with such a profile gives it.
    Rgba8 read(const Rgba8& colour, const std::string& icc) {
        EXPECT_TRUE(write_jpeg(file_, Image<Rgba8>(32, 16, colour), 100).ok());
        if (!icc.empty()) test::add_profile(file_, icc);
        const Result<Image<Rgba8>> picture = read_picture(file_);
        EXPECT_TRUE(picture.ok()) << picture.error().message;
        return (*picture)(20, 8);
    }
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "photo.jpg";
};

TEST_F(PictureColours, OfDisplayP3BecomeSrgb) {
    const std::string p3 = icc_of(Primaries::display_p3);
    for (const Rgba8& colour : {Rgba8{200, 150, 100, 255}, {60, 120, 90, 255}, {180, 60, 70, 255}}) {
        const Rgba8 shown = srgb_of_p3(colour);
        ASSERT_GT(std::abs(shown.r - colour.r) + std::abs(shown.g - colour.g), 8) << "a colour that tells";
        expect_near(read(colour, p3), shown, 2);
        const Result<Image<RgbaF>> light = read_picture_linear(file_);
        ASSERT_TRUE(light.ok()) << light.error().message;
        EXPECT_NEAR((*light)(20, 8).r, linear_from_srgb8(shown.r), 0.01);
        EXPECT_NEAR((*light)(20, 8).b, linear_from_srgb8(shown.b), 0.01);
    }
    expect_near(read({250, 10, 20, 255}, p3), {255, 0, 0, 255}, 12);  // beyond sRGB: its edge
    expect_near(read({128, 128, 128, 255}, p3), {128, 128, 128, 255}, 1);
}

TEST_F(PictureColours, OfSrgbStayAsTheyAre) {
    const std::string srgb = icc_of(Primaries::srgb);
    for (const Rgba8& colour : {Rgba8{200, 150, 100, 255}, {3, 250, 120, 255}}) {
        EXPECT_EQ(read(colour, srgb), read(colour, ""));
    }
}

TEST_F(PictureColours, StayWhereTheProfileIsNone) {
    const std::string p3 = icc_of(Primaries::display_p3);
    const Rgba8 colour{200, 150, 100, 255};
    for (const std::string& icc : {std::string("no profile"), p3.substr(0, p3.size() / 2), std::string(40000, 'x')}) {
        EXPECT_EQ(read(colour, icc), read(colour, "")) << icc.size();
    }
}

// OpenImageIO 2.4 follows a profile's table of tags wherever it points to.
TEST_F(PictureColours, OfADamagedProfileAreRefusedOrRead) {
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
        const Result<Image<Rgba8>> picture = read_picture(file_);
        if (picture) continue;
        ++refused;
        EXPECT_NE(picture.error().message.find("photo.jpg: its colour profile is damaged"), std::string::npos)
            << picture.error().message;
        EXPECT_FALSE(read_picture_info(file_).ok());
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 390);
}

TEST_F(PictureColours, OfATiffOrWebpWithADamagedProfileAreRefusedToo) {
    // A profile of one tag that lies behind its end, as it stands in files of both kinds.
    std::string profile(144, '\0');
    profile[3] = static_cast<char>(144);
    profile.replace(36, 4, "acsp");
    profile[131] = 1;
    profile.replace(132, 4, "desc");
    profile[138] = 1;  // at 256
    profile[143] = 20;
    for (const std::string& begin : {std::string("II*\0", 4), std::string("RIFF....WEBP")}) {
        std::ofstream(file_, std::ios::binary) << begin << std::string(100, 'x') << profile << "end";
        const Result<PictureInfo> info = read_picture_info(file_);
        ASSERT_FALSE(info.ok());
        EXPECT_NE(info.error().message.find("its colour profile is damaged"), std::string::npos)
            << info.error().message;
    }
}

}  // namespace
