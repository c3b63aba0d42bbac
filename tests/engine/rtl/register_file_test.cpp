// The register file beside that of the model: programs are written, checked and accepted or refused, objects are
// replaced, and in every cycle all readers must get the registers of the model.

#include "engine/rtl/simulation/disk_card.hpp"
#include "engine/rtl/simulation/host_side.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vregister_file.h>
#include <Vregister_file_mutants.h>

namespace rs::engine::rtl {
namespace {

constexpr std::uint64_t low_bits(std::int64_t value, int width_bits) {
    return static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << width_bits) - 1);
}

/// Changes a number of the view so that the board refuses it, mostly.
void make_invalid(model::BoardView& view, const model::RegisterFile& file, Random& random) {
    const bool exists = view.object >= 0 && view.object < static_cast<int>(file.objects.size());
    const int planes = exists ? file.objects[static_cast<std::size_t>(view.object)].planes : 1;
    model::PlaneView& plane = view.planes[static_cast<std::size_t>(random.in(0, std::max(0, planes - 1)))];
    const std::int64_t sign = random.chance(0.5) ? 1 : -1;
    const auto beyond = [&](int bits) { return sign * ((std::int64_t{1} << (bits - 1)) + 1); };
    switch (random.in(0, 11)) {
        case 0:
            view.object = static_cast<int>(random.in(20, 40));
            break;
        case 1:
            view.width = random.chance(0.5) ? 0 : 513;
            break;
        case 2:
            view.height = random.chance(0.5) ? 0 : 513;
            break;
        case 3:
            view.b_q20 = static_cast<std::int32_t>(beyond(29));
            break;
        case 4:
            view.s0_q32 = beyond(36);
            break;
        case 5:
            view.sy_q32 = beyond(34);
            break;
        case 6:
            plane.a_q20 = static_cast<std::int32_t>(beyond(29));
            break;
        case 7:
            plane.c_q20 = static_cast<std::int32_t>(beyond(29));
            break;
        case 8:
            plane.n0_q32 = beyond(36);
            break;
        case 9:
            plane.t0_q32 = beyond(36);
            break;
        case 10:  // just in range or just out of it in the last column
            view.width = std::max(view.width, 2);
            plane.n0_q32 = random.in(-9, 9);
            plane.nx_q32 = (sign * (std::int64_t{1} << 35) + random.in(-2, 2)) / (view.width - 1);
            break;
        default:
            view.width = std::max(view.width, 2);
            plane.t0_q32 = random.in(-9, 9);
            plane.tx_q32 = (sign * (std::int64_t{1} << 35) + random.in(-2, 2)) / (view.width - 1);
            break;
    }
}

template <class Module>
class RegisterFileBench {
public:
    RegisterFileBench(Module& module, Random& random) : module_(module), random_(random) {
        file_.objects.assign(20, {});
        file_.loaded.resize(20);
        module.rst = 1;
        clock();
        clock();
        module.rst = 0;
    }

    /// Writes `programs` programs. Returns the first difference, or "".
    std::string run(int programs) {
        for (int n = 0; n < 20; ++n) replace_object(n);
        for (int n = 0; n < programs && difference_.empty(); ++n) {
            if (random_.chance(0.5)) replace_object(static_cast<int>(random_.in(0, 19)));
            write_program();
        }
        return difference_;
    }

private:
    void clock() {
        module_.clk = 1;
        module_.eval();
        module_.clk = 0;
        module_.host_writes = module_.card_writes = module_.accepts_program = module_.validates_object = 0;
        module_.view_starts = 0;
        module_.eval();
    }
    // The card writes registers of an empty slot; the slot becomes valid with its last write, or when it is loaded.
    void replace_object(int slot) {
        if (is_used(slot)) return;
        DiskCard card({});
        card.evict(slot);
        model::ObjectRegisters registers = random_object(random_);
        card.place(slot, registers);
        const bool by_load = random_.chance(0.3);
        const bool stays_empty = random_.chance(0.1);
        while (!card.is_idle()) {
            const ObjectRegisterWrite write = card.inputs().write;
            if (card.is_idle() && (by_load || stays_empty)) break;
            module_.card_writes = 1;
            module_.card_object = static_cast<CData>(write.object);
            module_.card_register = static_cast<CData>(write.number);
            module_.card_data = write.data;
            clock();
        }
        if (by_load && !stays_empty) {
            module_.validates_object = 1;
            module_.loaded_object = static_cast<CData>(slot);
            clock();
        }
        registers.valid = !stays_empty;
        file_.objects[static_cast<std::size_t>(slot)] = registers;
    }
    [[nodiscard]] bool is_used(int slot) const {
        for (const model::ViewBank& bank : file_.banks) {
            for (const model::BoardView& view : bank.views) {
                if (view.object == slot) return true;
            }
        }
        return false;
    }

    void write_program() {
        model::ViewBank bank;
        const std::int64_t views = random_.chance(0.9) ? random_.in(1, 4) : random_.in(0, 17);
        for (std::int64_t n = 0; n < views; ++n) bank.views.push_back(random_board_view(file_, random_));
        if (views > 0 && random_.chance(0.4)) {
            make_invalid(bank.views[static_cast<std::size_t>(random_.in(0, views - 1))], file_, random_);
        }
        for (const RegisterWrite& write : program_writes(bank, file_.objects)) {
            for (std::int64_t n = random_.in(2, 6); n > 0 && difference_.empty(); --n) read_and_clock();
            module_.host_writes = 1;
            module_.host_address = write.address;
            module_.host_data = write.data;
            if (write.address == 0xFFF) end_program(bank);
            clock();
        }
        if (random_.chance(0.7)) start_views();
    }
    void end_program(const model::ViewBank& bank) {
        const model::BoardConfig config = *model::read_board_config("prototype-2000");
        bool is_valid = !bank.views.empty() && bank.views.size() <= 15;
        std::string error;
        for (const model::BoardView& view : bank.views) {
            error = model::register_error(view, file_, config.limits);
            is_valid = is_valid && error.empty();
        }
        module_.eval();
        if ((module_.program_is_valid != 0) != is_valid) {
            difference_ =
                std::string("the program is ") + (is_valid ? "valid" : "invalid") + " in the model, not in the RTL";
        } else if (is_valid && module_.program_views != bank.views.size()) {
            difference_ = "another number of views";
        }
        const int next = 1 - file_.active;
        module_.next_bank = static_cast<CData>(next);
        module_.accepts_program = is_valid && random_.chance(0.8);
        if (module_.accepts_program != 0) file_.banks[static_cast<std::size_t>(next)] = bank;
    }
    // As render_control: the other bank is drawn, and its views are started.
    void start_views() {
        const auto next = static_cast<std::size_t>(1 - file_.active);
        if (file_.banks[next].views.empty()) return;
        file_.active = static_cast<int>(next);
        module_.active_bank = static_cast<CData>(next);
        file_.buffer_words[next].clear();
        for (const model::BoardView& view : file_.banks[next].views) {
            module_.view_starts = 1;
            module_.started_view = static_cast<CData>(file_.buffer_words[next].size());
            module_.eval();
            clock();
            file_.buffer_words[next].push_back(view.words());
        }
    }

    void read_and_clock() {
        if (!file_.banks[static_cast<std::size_t>(file_.active)].views.empty()) {
            for (CData* view :
                 {&module_.raster_view, &module_.position_view, &module_.line_view, &module_.compensation_view,
                  &module_.address_view, &module_.scan_view, &module_.writer_view}) {
                *view = static_cast<CData>(random_view(file_, random_));
            }
            module_.raster_plane = random_plane(module_.raster_view);
            module_.position_plane = random_plane(module_.position_view);
            module_.eval();
            compare_views();
            compare_objects();
        }
        const auto buffer = static_cast<std::size_t>(random_.in(0, 1));
        const std::vector<int>& words = file_.buffer_words[buffer];
        if (!words.empty()) {
            const std::int64_t view = random_.in(0, static_cast<std::int64_t>(words.size()) - 1);
            module_.buffer = static_cast<CData>(buffer);
            module_.buffer_view = static_cast<CData>(view);
            module_.eval();
            expect("buffer_views", module_.buffer_views, words.size());
            expect("buffer_words", module_.buffer_words, static_cast<std::uint64_t>(words[std::size_t(view)]));
        }
        clock();
    }
    CData random_plane(int view) { return static_cast<CData>(random_.in(0, file_.object_of(view).planes - 1)); }
    void expect(const char* name, std::uint64_t found, std::uint64_t expected) {
        if (found == expected || !difference_.empty()) return;
        difference_ = std::string(name) + " is " + std::to_string(found) + ", not " + std::to_string(expected);
    }
    void expect(const char* name, std::uint64_t found, int expected) {
        expect(name, found, static_cast<std::uint64_t>(expected));
    }
    void compare_views() {
        const Module& m = module_;
        const model::PlaneView& raster = file_.view(m.raster_view).planes[m.raster_plane];
        expect("raster_view_width", m.raster_view_width, file_.view(m.raster_view).width);
        expect("raster_plane_c", m.raster_plane_c_q20, low_bits(raster.c_q20, 29));
        expect("raster_plane_n0", m.raster_plane_n0_q32, low_bits(raster.n0_q32, 36));
        expect("raster_plane_nx", m.raster_plane_nx_q32, low_bits(raster.nx_q32, 36));
        expect("raster_plane_t0", m.raster_plane_t0_q32, low_bits(raster.t0_q32, 36));
        expect("raster_plane_tx", m.raster_plane_tx_q32, low_bits(raster.tx_q32, 36));
        const model::PlaneView& position = file_.view(m.position_view).planes[m.position_plane];
        expect("position_plane_a", m.position_plane_a_q20, low_bits(position.a_q20, 29));
        expect("position_plane_c", m.position_plane_c_q20, low_bits(position.c_q20, 29));
        const model::BoardView& compensated = file_.view(m.compensation_view);
        expect("compensation_view_b", m.compensation_view_b_q20, low_bits(compensated.b_q20, 29));
        expect("compensation_view_s0", m.compensation_view_s0_q28, low_bits(compensated.s0_q32 >> 4, 32));
        expect("compensation_view_sy", m.compensation_view_sy_q32, low_bits(compensated.sy_q32, 34));
        expect("scan_view_height", m.scan_view_height, file_.view(m.scan_view).height);
        expect("writer_view_width", m.writer_view_width, file_.view(m.writer_view).width);
        expect("writer_view_height", m.writer_view_height, file_.view(m.writer_view).height);
    }
    void compare_objects() {
        const Module& m = module_;
        expect("raster_object_planes", m.raster_object_planes, file_.object_of(m.raster_view).planes);
        const model::ObjectRegisters& met = file_.object_of(m.position_view);
        expect("x_cells", m.position_object_x_cells, met.x_cells);
        expect("u_cells", m.position_object_u_cells, met.u_cells);
        expect("x_half", m.position_object_x_half_q20, met.x_half_q20);
        expect("u_half", m.position_object_u_half_q28, met.u_half_q28);
        expect("x_cells_per_unit", m.position_object_x_cells_per_unit_q12, low_bits(met.x_cells_per_unit_q12, 32));
        expect("u_cells_per_unit", m.position_object_u_cells_per_unit_q12, low_bits(met.u_cells_per_unit_q12, 32));
        expect("map", m.position_object_map, std::uint64_t{met.map});
        expect("line_object_planes", m.line_object_planes, file_.object_of(m.line_view).planes);
        expect("line_object_lines", m.line_object_lines, std::uint64_t{file_.object_of(m.line_view).lines});
        expect("compensation_object_width", m.compensation_object_width, file_.object_of(m.compensation_view).width);
        const model::ObjectRegisters& addressed = file_.object_of(m.address_view);
        expect("address_object_width", m.address_object_width, addressed.width);
        expect("luma_pitch", m.address_object_luma_pitch, addressed.luma_pitch);
        expect("chroma_pitch", m.address_object_chroma_pitch, addressed.chroma_pitch);
        expect("alpha_pitch", m.address_object_alpha_pitch, addressed.alpha_pitch);
        expect("luma", m.address_object_luma, std::uint64_t{addressed.luma});
        expect("chroma", m.address_object_chroma, std::uint64_t{addressed.chroma});
        expect("alpha", m.address_object_alpha, std::uint64_t{addressed.alpha});
        expect("scan_object_height", m.scan_object_height, file_.object_of(m.scan_view).height);
    }

    Module& module_;
    Random& random_;
    model::RegisterFile file_;
    std::string difference_;
};

template <class Module>
std::string check_programs(int programs, int mutant, int seed = 11) {
    Random random(static_cast<std::uint64_t>(seed));
    VerilatedContext context;
    context.randReset(2);
    context.randSeed(seed);
    Module module(&context);
    if constexpr (requires { module.mutant; }) module.mutant = static_cast<CData>(mutant);
    return RegisterFileBench<Module>(module, random).run(programs);
}

TEST(RtlRegisterFile, EqualsTheModel) {
    for (int seed = 1; seed <= 8; ++seed) {
        EXPECT_EQ(check_programs<Vregister_file>(300, 0, seed), "") << "seed " << seed;
    }
}

TEST(RtlRegisterFile, MutantsDifferFromTheModel) {
    constexpr int kPrograms = 600;
    EXPECT_EQ(check_programs<Vregister_file_mutants>(kPrograms, 0), "");
    VerilatedContext context;
    Vregister_file_mutants module(&context);
    module.eval();
    EXPECT_GE(module.mutants, kLeastMutants);
    for (int n = 1; n <= module.mutants; ++n) {
        EXPECT_NE(check_programs<Vregister_file_mutants>(kPrograms, n), "") << "mutant " << n << " is not noticed";
    }
}

}  // namespace
}  // namespace rs::engine::rtl
