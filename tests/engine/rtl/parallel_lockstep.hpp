#pragma once
// Blocks of a pipe of `parallel` in RTL beside a board of the model: the first pipe of the board, and the look-ups of
// its blocks in the register file.

#include "tests/engine/model/parallel_test_objects.hpp"
#include "tests/engine/rtl/lockstep.hpp"

namespace rs::engine::rtl {

/// Base of the benches.
template <class Module>
class ParallelLockstepBench : public LockstepBench<Module> {
protected:
    ParallelLockstepBench(Module& module, model::Board& board, Random& random)
        : LockstepBench<Module>(module, board, random), pipe_(*model::test::pipes(board).front()) {}

    // Column side.
    [[nodiscard]] const model::PlaneView& plane(int view, unsigned number) const {
        return this->view(view).planes[std::min<std::size_t>(number, model::kMaxPlanes - 1)];
    }
    void look_up_columns() {
        look_up_column_rays();
        look_up_images();
        look_up_set_up();
    }
    void look_up_column_rays() {
        Module& m = this->module_;
        const model::PlaneView& raster = plane(m.raster_view, m.raster_plane);
        m.raster_view_width = static_cast<SData>(this->view(m.raster_view).width);
        m.raster_object_planes = static_cast<CData>(this->object(m.raster_view).planes);
        m.raster_plane_c_q20 = static_cast<IData>(raster.c_q20) & kMask29;
        m.raster_plane_n0_q32 = static_cast<QData>(raster.n0_q32) & mask(36);
        m.raster_plane_nx_q32 = static_cast<QData>(raster.nx_q32) & mask(36);
        m.raster_plane_t0_q32 = static_cast<QData>(raster.t0_q32) & mask(36);
        m.raster_plane_tx_q32 = static_cast<QData>(raster.tx_q32) & mask(36);
        const model::ObjectRegisters& object = this->object(m.position_view);
        const model::PlaneView& position = plane(m.position_view, m.position_plane);
        m.position_object_x_cells = static_cast<SData>(object.x_cells);
        m.position_object_u_cells = static_cast<SData>(object.u_cells);
        m.position_object_x_half_q20 = static_cast<IData>(object.x_half_q20);
        m.position_object_u_half_q28 = static_cast<IData>(object.u_half_q28);
        m.position_object_x_cells_per_unit_q12 = static_cast<IData>(object.x_cells_per_unit_q12);
        m.position_object_u_cells_per_unit_q12 = static_cast<IData>(object.u_cells_per_unit_q12);
        m.position_object_map = object.map;
        m.position_plane_a_q20 = static_cast<IData>(position.a_q20) & kMask29;
        m.position_plane_c_q20 = static_cast<IData>(position.c_q20) & kMask29;
    }
    void look_up_images() {
        Module& m = this->module_;
        const model::ObjectRegisters& bracket = this->object(m.bracket_view);
        m.bracket_object_has_shape = bracket.shape.exists;
        m.bracket_object_images = static_cast<CData>(bracket.images);
        m.bracket_object_planes = static_cast<CData>(bracket.planes);
        m.bracket_object_lines = bracket.lines;
        const model::ObjectRegisters& picture = this->object(m.picture_view);
        m.picture_object_planes = static_cast<CData>(picture.planes);
        m.picture_object_lines = picture.lines;
    }
    void look_up_set_up() {
        Module& m = this->module_;
        const model::BoardView& view = this->view(m.setup_view);
        const model::PlaneView& setup = plane(m.setup_view, m.setup_plane);
        const model::ShapeRegisters& shape = this->object(m.setup_view).shape;
        m.setup_view_b_q20 = static_cast<IData>(view.b_q20) & kMask29;
        m.setup_view_s0_q28 = static_cast<IData>(view.s0_q32 >> 4);
        m.setup_view_sy_q32 = static_cast<QData>(view.sy_q32) & mask(34);
        m.setup_plane_a_q20 = static_cast<IData>(setup.a_q20) & kMask29;
        m.setup_plane_c_q20 = static_cast<IData>(setup.c_q20) & kMask29;
        m.setup_object_width = static_cast<SData>(this->object(m.setup_view).width);
        m.setup_shape_p_cells = static_cast<SData>(shape.p_cells);
        m.setup_shape_lines = static_cast<IData>(shape.lines);
        m.setup_shape_p_half_q20 = static_cast<IData>(shape.p_half_q20);
        m.setup_shape_p_cells_per_unit_q12 = static_cast<IData>(shape.p_cells_per_unit_q12);
        m.setup_shape_reference_distance_q20 = static_cast<IData>(shape.reference_distance_q20);
        m.setup_shape_depth_low_q20 = static_cast<IData>(shape.depth_low_q20);
        m.setup_shape_depth_step_q24 = static_cast<IData>(shape.depth_step_q24);
        const model::ShapeRegisters& band = this->object(m.band_view).shape;
        m.band_view_width = static_cast<SData>(this->view(m.band_view).width);
        m.band_shape_p_cells = static_cast<SData>(band.p_cells);
        m.band_shape_bands = static_cast<SData>(band.bands);
        m.band_shape_cells = band.cells;
    }

    // Effective depths of all objects, which the host writes before the first view.
    void drive_effective_depths() {
        const auto& objects = this->board_.top().registers.objects;
        const auto object = static_cast<std::size_t>(written_ / EffectiveDepth::kDepths);
        const auto depth = static_cast<std::size_t>(written_ % EffectiveDepth::kDepths);
        Module& m = this->module_;
        m.effective_depths_valid = object < objects.size() && objects[object].valid;
        if (m.effective_depths_valid == 0) return;
        m.effective_depths_data =
            static_cast<IData>(bits(objects[object].shape.effective_depth_q3[depth], 13) | bits(written_, 13) << 13U);
    }
    void count_effective_depths() {
        if (this->module_.effective_depths_valid != 0 && this->module_.effective_depths_ready != 0) ++written_;
    }
    // Blocks that follow the rays of pixels.
    void look_up_pixels() {
        Module& m = this->module_;
        const model::BoardView& scan = this->view(m.scan_view);
        m.scan_view_width = static_cast<SData>(scan.width);
        m.scan_view_height = static_cast<SData>(scan.height);
        m.scan_view_s0_q32 = bits(scan.s0_q32, 36);
        m.scan_view_sy_q32 = bits(scan.sy_q32, 34);
        const model::ShapeRegisters& rise = this->object(m.rise_view).shape;
        m.rise_view_b_q20 = static_cast<IData>(bits(this->view(m.rise_view).b_q20, 29));
        m.rise_shape_h_low_q20 = static_cast<IData>(bits(rise.h_low_q20, 29));
        m.rise_shape_reference_height_q20 = static_cast<IData>(bits(rise.reference_height_q20, 29));
        m.rise_shape_bands_per_unit_q12 = static_cast<IData>(rise.bands_per_unit_q12);
        m.rise_shape_depth_step_q24 = static_cast<IData>(rise.depth_step_q24);
        const model::ShapeRegisters& loading = this->object(m.loading_view).shape;
        m.loading_shape_bands = static_cast<SData>(loading.bands);
        m.loading_shape_jump = static_cast<CData>(loading.jump);
        const model::ShapeRegisters& march = this->object(m.march_view).shape;
        m.march_view_object = static_cast<CData>(this->view(m.march_view).object);
        m.march_shape_bands = static_cast<SData>(march.bands);
        m.march_shape_jump = static_cast<CData>(march.jump);
        m.march_shape_thickness = static_cast<CData>(march.thickness);
        m.march_shape_foot_d_q3 = static_cast<SData>(march.foot_d_q3);
        const model::RegisterFile& registers = this->board_.top().registers;
        m.store_view_height = static_cast<SData>(this->view(m.store_view).height);
        m.store_view_image = registers.image(registers.active, m.store_view);
    }

    model::ParallelPipe& pipe_;

private:
    static std::uint64_t bits(std::int64_t value, int width) { return static_cast<std::uint64_t>(value) & mask(width); }
    static constexpr auto kMask29 = static_cast<IData>(mask(29));
    int written_ = 0;  // effective depths, object by object
};

}  // namespace rs::engine::rtl
