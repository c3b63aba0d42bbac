#include "compositor/gpu/gpu_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/gpu/shader/texture_layout.hpp"
#include "compositor/gpu/shader/view_setup.hpp"
#include "compositor/gpu/shader/view_uniforms.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kMaxSetups = 1 << 18;  // of a draw call: 28 MiB
constexpr int kFirstLayers = 16;     // of an object: photos of a typical view

void set_layers(const SetupTexel& head, SetupTexel& view, const ObjectTextures& textures) {
    const PhotosOfSetup photos = photos_of(head, view);
    const int first = photos.first < 0 ? 0 : textures.layer_of(photos.first);
    const int second = photos.second < 0 ? 0 : textures.layer_of(photos.second);
    if (static_cast<SetupKind>(head[0] & 3) == SetupKind::kPlane) {
        view[0] = first;
    } else {
        view[2] = first | second << 16;
    }
}

}  // namespace

// A view that is being drawn, with the set-ups of rows first_row .. first_row + setup_rows - 1, or of all rows.
struct GpuRenderer::View {
    std::shared_ptr<const GpuObject> object;
    const engine::ViewRegisters& registers;
    const gl::IntegerTarget& target;
    ObjectEntry& entry;
    bool upright = false;
    int first_row = 0;
    int setup_rows = 1;
    std::vector<SetupTexel> setups = {};
    std::vector<PixelRect> visible = {};  // what was drawn

    // Calls work(head, view) for texels 0 and 1 of each set-up of a block.
    template <class Work>
    void for_each_setup(const PixelRect& block, const Work& work) {
        const int first = upright ? 0 : block.top - first_row;
        const int rows = upright ? 1 : block.height;
        const auto across = static_cast<std::size_t>(registers.width);
        for (int row = first; row < first + rows; ++row) {
            SetupTexel* const heads = setups.data() + static_cast<std::size_t>(row) * kSetupTexels * across;
            for (int column = block.left; column < block.left + block.width; ++column) {
                work(heads[column], heads[across + static_cast<std::size_t>(column)]);
            }
        }
    }

    std::vector<int> photos_of_block(const PixelRect& block) {
        std::vector<bool> is_read(object->object().views.size());
        for_each_setup(block, [&](const SetupTexel& head, const SetupTexel& view) {
            const PhotosOfSetup photos = photos_of(head, view);
            for (const int photo : {photos.first, photos.second}) {
                if (photo >= 0) is_read[static_cast<std::size_t>(photo)] = true;
            }
        });
        std::vector<int> photos;
        for (std::size_t photo = 0; photo < is_read.size(); ++photo) {
            if (is_read[photo]) photos.push_back(static_cast<int>(photo));
        }
        return photos;
    }
};

GpuRenderer::GpuRenderer(gl::Program program, const GpuRendererOptions& options)
    : program_(std::move(program)), limits_(gl::texture_limits()), memory_bytes_(options.memory_bytes) {}

Result<GpuRenderer> GpuRenderer::create(const GpuRendererOptions& options) {
    RS_ASSIGN_OR_RETURN(gl::Program program,
                        gl::Program::create("reconstruction", reconstruction_vertex_shader(options.dialect),
                                            reconstruction_fragment_shader(options.dialect)));
    program.set("setups", static_cast<int>(kSetupUnit));
    program.set("cells", static_cast<int>(kCellUnit));
    program.set("photos", static_cast<int>(kPhotoUnit));
    program.set("details", static_cast<int>(kDetailUnit));
    return GpuRenderer(std::move(program), options);
}

Status GpuRenderer::reserve_setups(int width, int setup_rows) {
    const int texel_rows = setup_rows * kSetupTexels;
    if (setups_ && setups_->width() >= width && setups_->height() >= texel_rows) return {};
    const int columns = std::max(width, setups_ ? setups_->width() : 1);
    setups_.reset();
    RS_ASSIGN_OR_RETURN(setups_, gl::IntegerTexture::create(gl::IntegerFormat::kSigned32x4, columns, texel_rows));
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

std::int64_t GpuRenderer::memory_bytes() const {
    std::int64_t bytes = 0;
    for (const auto& [object, entry] : objects_) bytes += entry.bytes();
    return bytes;
}

void GpuRenderer::forget_evicted_objects() {
    std::erase_if(objects_, [](const auto& entry) { return entry.second.object.expired(); });
}

Result<GpuRenderer::ObjectEntry*> GpuRenderer::entry_of(const std::shared_ptr<const GpuObject>& object) {
    auto found = objects_.find(object.get());
    if (found == objects_.end()) {
        const auto views = static_cast<int>(object->object().views.size());
        const std::int64_t cells = gpu_bytes(object->object(), 0);
        const std::int64_t layer = gpu_bytes(object->object(), 1) - cells;
        const int layers = std::min(views, kMinPhotoLayers);
        RS_TRY(check_texture_limits(object->object(), layers, limits_.side, limits_.layers));
        RS_ASSIGN_OR_RETURN(ObjectTextures textures, ObjectTextures::create(*object, layers));
        found = objects_.emplace(object.get(), ObjectEntry{object, std::move(textures), cells, layer, 0}).first;
    }
    found->second.last_drawn = ++now_;
    return &found->second;
}

// Frees the textures of the object that was drawn least recently.
void GpuRenderer::free_least_recently_drawn(const ObjectEntry& but) {
    auto oldest = objects_.end();
    for (auto entry = objects_.begin(); entry != objects_.end(); ++entry) {
        if (&entry->second == &but) continue;
        if (oldest == objects_.end() || entry->second.last_drawn < oldest->second.last_drawn) oldest = entry;
    }
    if (oldest != objects_.end()) objects_.erase(oldest);
}

// Enlarges the textures of an object for photos that have no room in them: twice as large if the memory allows it, else
// as large as the photos need at the expense of other objects.
Status GpuRenderer::make_room(const GpuObject& object, ObjectEntry& entry, const std::vector<int>& photos) {
    while (memory_bytes() > memory_bytes_ && objects_.size() > 1) free_least_recently_drawn(entry);
    if (entry.textures.have_room_for(photos)) return {};
    const auto needed = static_cast<int>(photos.size());
    const int most = std::min(static_cast<int>(object.object().views.size()), limits_.layers);
    const int layers = entry.textures.layers();
    const auto affordable = [&] {
        const std::int64_t left = memory_bytes_ - (memory_bytes() - entry.textures.layers() * entry.layer_bytes);
        return static_cast<int>(std::clamp<std::int64_t>(left / entry.layer_bytes, 0, most));
    };
    while (needed > layers && affordable() < std::min(needed, most) && objects_.size() > 1) {
        free_least_recently_drawn(entry);
    }
    const int wanted = std::min(std::max({needed, 2 * layers, kFirstLayers}), affordable());
    return wanted > layers ? entry.textures.resize(object, wanted) : Status();
}

// Draws a block, in halves if it reads more photos than the textures hold.
Status GpuRenderer::draw_block(View& view, const PixelRect& block) {
    const std::vector<int> photos = view.photos_of_block(block);
    RS_TRY(make_room(*view.object, view.entry, photos));
    if (photos.size() > static_cast<std::size_t>(view.entry.textures.layers())) {
        PixelRect halves[2] = {block, block};
        if (block.width > 1) {
            halves[0].width = block.width / 2;
            halves[1].left = block.left + halves[0].width;
            halves[1].width = block.width - halves[0].width;
        } else {
            halves[0].height = block.height / 2;
            halves[1].top = block.top + halves[0].height;
            halves[1].height = block.height - halves[0].height;
        }
        RS_TRY(draw_block(view, halves[0]));
        return draw_block(view, halves[1]);
    }
    view.entry.textures.load(*view.object, photos);
    view.for_each_setup(
        block, [&](const SetupTexel& head, SetupTexel& texel) { set_layers(head, texel, view.entry.textures); });
    setups_->upload(view.registers.width, view.setup_rows * kSetupTexels, view.setups.data());
    setups_->bind(kSetupUnit);
    view.entry.textures.bind(view.registers.ring);
    const ShapeMap& shape = view.object->object().rings[static_cast<std::size_t>(view.registers.ring)].shape;
    for (const PixelRect& shown : visible_rectangles(view.setups, view.first_row, view.registers, shape, block)) {
        view.target.begin(shown.left, shown.top, shown.width, shown.height);
        gl::draw(program_, triangle_, {.depth_test = false, .depth_write = false});
        view.visible.push_back(shown);
    }
    return {};
}

Result<std::vector<PixelRect>> GpuRenderer::draw(const std::shared_ptr<const GpuObject>& object,
                                                 const engine::ViewRegisters& registers,
                                                 const gl::IntegerTarget& target) {
    forget_evicted_objects();
    RS_ASSIGN_OR_RETURN(ObjectEntry * entry, entry_of(object));
    View view{object, registers, target, *entry, registers.upright()};
    const int rows_at_once =
        std::clamp(std::min(kMaxSetups / registers.width, limits_.side / kSetupTexels), 1, registers.height);
    const int draw_rows = view.upright ? registers.height : rows_at_once;
    RS_TRY(reserve_setups(registers.width, view.upright ? 1 : rows_at_once));
    set_uniforms(object->object(), registers);
    target.clear();
    for (int first = 0; first < registers.height; first += draw_rows) {
        const int rows = std::min(draw_rows, registers.height - first);
        view.first_row = first;
        view.setup_rows = view.upright ? 1 : rows;
        view.setups = set_up_rows(object->object(), registers, object->bounds(registers.ring), first, view.setup_rows);
        program_.set("setup_rows", glm::ivec2(first, view.upright ? 0 : kSetupTexels));
        RS_TRY(draw_block(view, {0, first, registers.width, rows}));
    }
    return std::move(view.visible);
}

Result<engine::ExecutedView> GpuRenderer::render(const std::shared_ptr<const GpuObject>& object,
                                                 const engine::ViewRegisters& registers, bool depth) {
    if (!target_ || target_->width() < registers.width || target_->height() < registers.height) {
        const int width = std::max(registers.width, target_ ? target_->width() : 1);
        const int height = std::max(registers.height, target_ ? target_->height() : 1);
        target_.reset();
        RS_ASSIGN_OR_RETURN(target_, gl::IntegerTarget::create(width, height));
    }
    RS_ASSIGN_OR_RETURN(const std::vector<PixelRect> visible, draw(object, registers, *target_));
    static_cast<void>(visible);
    engine::ExecutedView view;
    view.image = Image<Rgba8>(registers.width, registers.height);
    if (depth) view.depth_q20 = Image<std::int32_t>(registers.width, registers.height);
    target_->read(view.image, view.depth_q20);
    return view;
}

}  // namespace rs::compositor
