// Inputs of WebGL (compositor/web/view/shader_inputs.hpp).

#include "compositor/web/view/shader_inputs.hpp"

#include "compositor/gpu/shader/photo_texels.hpp"

#include "engine/core/definition/texel_detail.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/object/yuv.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace rs::web {
namespace {

struct OpenedObject {
    RaySpaceObject decoded;
    ObjectView view;
};

Result<OpenedObject> opened_shape() {
    const test::TemporaryFolder folder;
    RS_TRY(write_object(folder / "thing.rso", test::small_object_with_shape()));
    RS_ASSIGN_OR_RETURN(RaySpaceObject decoded, read_object(folder / "thing.rso"));
    RS_ASSIGN_OR_RETURN(std::vector<std::byte> file, read_file(folder / "thing.rso", 1U << 24));
    RS_ASSIGN_OR_RETURN(ObjectView view, ObjectView::open(std::move(file), "thing", 3));
    return OpenedObject{std::move(decoded), std::move(view)};
}

TEST(ShaderInputs, PhotosAreThoseOfTheObject) {
    const Result<OpenedObject> opened = opened_shape();
    ASSERT_TRUE(opened) << opened.error().message;
    for (std::size_t view = 0; view < opened->decoded.images.size(); ++view) {
        const PlanarImage& image = opened->decoded.images[view];
        const compositor::PhotoTexels texels = compositor::photo_texels(opened->view.texels(), static_cast<int>(view),
                                                                        opened->decoded.width, opened->decoded.height);
        ASSERT_EQ(texels.colours.width(), image.y.width());
        ASSERT_EQ(texels.colours.height(), image.y.height());
        for (int row = 0; row < image.y.height(); ++row) {
            for (int column = 0; column < image.y.width(); ++column) {
                ASSERT_EQ(texels.colours(column, row), rgba_at(image, column, row));
                ASSERT_EQ(texels.details(column, row), engine::texel_detail_at(image, column, row));
            }
        }
    }
}

TEST(ShaderInputs, UprightViewsHaveOneRowOfSetUps) {
    const Result<OpenedObject> opened = opened_shape();
    ASSERT_TRUE(opened) << opened.error().message;
    const Result<PreparedView> prepared = opened->view.prepare({40, 30, 0.5, 0.1, 3.5});
    ASSERT_TRUE(prepared) << prepared.error().message;
    ASSERT_TRUE(prepared->rows) << "tilted views are resampled";
    ShaderInputs inputs;
    const ShaderView view = inputs.prepare(opened->view.object(), prepared->rings.nearest);
    EXPECT_EQ(view.setup_rows, 1);
    EXPECT_EQ(view.setups.size() % static_cast<std::size_t>(prepared->rings.nearest.width), 0U);
    EXPECT_FALSE(view.photos.empty());
}

// Each pixel of a tilted view has a set-up; large ones are left to the core.
TEST(ShaderInputs, LimitsTheSetUpsOfTiltedViews) {
    const Result<OpenedObject> opened = opened_shape();
    ASSERT_TRUE(opened) << opened.error().message;
    ShaderInputs inputs;
    for (const int side : {40, 800}) {
        const Result<PreparedView> prepared = opened->view.prepare({side, side, 0.5, 1.35, 3.5});
        ASSERT_TRUE(prepared) << prepared.error().message;
        ASSERT_FALSE(prepared->rows) << "too steep to be resampled";
        const ShaderView view = inputs.prepare(opened->view.object(), prepared->rings.nearest);
        EXPECT_EQ(view.setup_rows, side);
        EXPECT_EQ(view.setups.empty(), side == 800);
    }
}

}  // namespace
}  // namespace rs::web
