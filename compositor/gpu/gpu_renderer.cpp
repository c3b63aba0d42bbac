#include "compositor/gpu/gpu_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/gpu/shader/view_setup.hpp"
#include "compositor/gpu/shader/view_uniforms.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kMaxSetups = 1 << 18;  // of a draw call: 28 MiB

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
    for (const ShaderUniform& uniform : view_uniforms(object, registers)) {
        const auto& [x, y, z, w] = uniform.values;
        if (uniform.count == 1) program_.set(uniform.name, x);
        if (uniform.count == 2) program_.set(uniform.name, glm::ivec2(x, y));
        if (uniform.count == 4) program_.set(uniform.name, glm::ivec4(x, y, z, w));
    }
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
