#include "compositor/gpu/gpu_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/gpu/view_setup.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kMaxSetups = 1 << 18;  // of a draw call: 28 MiB

// A q32 number as two uniforms: shifted right by eight bits, and the lowest eight bits. The sum of a form is exact
// modulo 2^32 after the shift, and its value is within 32 bits (section "Ranges").
struct SplitForm {
    glm::ivec4 high{0};
    glm::ivec4 low{0};
};

SplitForm split(const engine::LinearForm& form) {
    SplitForm parts;
    const std::array<std::int64_t, 3> numbers{form.at_origin, form.per_column, form.per_row};
    for (int n = 0; n < 3; ++n) {
        parts.high[n] = static_cast<std::int32_t>(numbers[static_cast<std::size_t>(n)] >> 8);
        parts.low[n] = static_cast<std::int32_t>(numbers[static_cast<std::size_t>(n)] & 255);
    }
    return parts;
}

}  // namespace

GpuRenderer::GpuRenderer(gl::Program program) : program_(std::move(program)), side_limit_(gl::texture_limits().side) {}

Result<GpuRenderer> GpuRenderer::create(ShaderDialect dialect) {
    RS_ASSIGN_OR_RETURN(gl::Program program,
                        gl::Program::create("reconstruction", reconstruction_vertex_shader(dialect),
                                            reconstruction_fragment_shader(dialect)));
    program.set("setups", static_cast<int>(kSetupUnit));
    program.set("cells", static_cast<int>(kCellUnit));
    program.set("photos", static_cast<int>(kPhotoUnit));
    program.set("details", static_cast<int>(kDetailUnit));
    return GpuRenderer(std::move(program));
}

Status GpuRenderer::reserve(const engine::ViewRegisters& registers, int setup_rows) {
    const auto holds = [](const auto& images, int width, int height) {
        return images && images->width() >= width && images->height() >= height;
    };
    if (!holds(target_, registers.width, registers.height)) {
        const int width = std::max(registers.width, target_ ? target_->width() : 1);
        const int height = std::max(registers.height, target_ ? target_->height() : 1);
        target_.reset();
        RS_ASSIGN_OR_RETURN(target_, gl::IntegerTarget::create(width, height));
    }
    const int texel_rows = setup_rows * kSetupTexels;
    if (!holds(setups_, registers.width, texel_rows)) {
        const int width = std::max(registers.width, setups_ ? setups_->width() : 1);
        setups_.reset();
        RS_ASSIGN_OR_RETURN(setups_, gl::IntegerTexture::create(gl::IntegerFormat::kSigned32x4, width, texel_rows));
    }
    return {};
}

void GpuRenderer::set_uniforms(const RaySpaceObject& object, const engine::ViewRegisters& registers) const {
    const SplitForm rise = split(registers.rise);
    program_.set("rise_high", rise.high);
    program_.set("rise_low", rise.low);
    program_.set("b_q16", registers.b_q20 >> 4);
    program_.set("sampling", static_cast<int>(registers.filter));
    program_.set("photo_size", glm::ivec2(object.width, object.height));
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    program_.set("bands", shape.bands);
    program_.set("reference_q16", shape.reference_height_q20 >> 4);
    program_.set("h_low_q16", shape.h_low_q20 >> 4);
    program_.set("bands_per_unit", shape.bands_per_unit_q12);
    program_.set("depth_low", shape.depth_low_q20);
    program_.set("depth_step", shape.depth_step_q24);
    program_.set("jump", shape.jump);
    program_.set("thickness", shape.thickness);
}

Result<engine::ExecutedView> GpuRenderer::render(const GpuObject& object, const engine::ViewRegisters& registers,
                                                 bool depth) {
    const bool upright = registers.upright();
    const int rows_at_once =
        std::clamp(std::min(kMaxSetups / registers.width, side_limit_ / kSetupTexels), 1, registers.height);
    const int draw_rows = upright ? registers.height : rows_at_once;
    RS_TRY(reserve(registers, upright ? 1 : rows_at_once));
    set_uniforms(object.object(), registers);
    object.bind(registers.ring);
    setups_->bind(kSetupUnit);
    for (int first = 0; first < registers.height; first += draw_rows) {
        const int rows = std::min(draw_rows, registers.height - first);
        const int setup_rows = upright ? 1 : rows;
        const std::vector<SetupTexel> setups =
            set_up_rows(object.object(), registers, object.bounds(registers.ring), first, setup_rows);
        setups_->upload(registers.width, setup_rows * kSetupTexels, setups.data());
        program_.set("setup_rows", glm::ivec2(first, upright ? 0 : kSetupTexels));
        target_->begin_rows(registers.width, first, rows);
        gl::draw(program_, triangle_, {.depth_test = false, .depth_write = false});
    }
    engine::ExecutedView view;
    view.image = Image<Rgba8>(registers.width, registers.height);
    if (depth) view.depth_q20 = Image<std::int32_t>(registers.width, registers.height);
    target_->read(view.image, view.depth_q20);
    return view;
}

}  // namespace rs::compositor
