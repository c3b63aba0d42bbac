// Size and benefit of a shape map: held-out PSNR over the map's size, for several cell sizes.
//
//     bench_map_size SET HELD_OUT [-o curve.svg]
//
// HELD_OUT is a second set of the same object with other cameras (rs-capture synth --first-angle). Prints CSV: cell
// side in pixels, bytes in the file and their share of the raw images, bytes in memory and their share, PSNR in dB.

#include "encode/build.hpp"
#include "engine/core/fast/renderer.hpp"
#include "engine/core/views/compare.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/chunks/shape_chunk.hpp"
#include "rayspace/page/plots.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <cstdio>
#include <span>

namespace rs::encode {
namespace {

struct Arguments {
    std::string set;
    std::string held_out;
    std::string plot;
};

struct MapMeasurement {
    double share = 0;  // file size of the map over that of the raw images
    double psnr_db = 0;
};

Result<MapMeasurement> measure(const CaptureSet& set, const std::string& held_out, double cell_px) {
    BuildOptions options;
    options.map = default_plane_map(MapKind::kShape);
    options.shape.lines.cell_px = cell_px;
    RS_ASSIGN_OR_RETURN(BuiltObject built, build_object(set, options));
    std::size_t file_bytes = 0;
    std::size_t memory_bytes = 0;
    for (const Ring& ring : built.object.rings) {
        file_bytes += object_chunks::map_payload(ring).size();
        memory_bytes += ring.cells.size() * sizeof(ring.cells[0]) + ring.shape.cells.size() * sizeof(ShapeCell);
        if (!ring.shape.cells.empty()) file_bytes += object_chunks::shape_payload(ring).size();
    }
    const double raw_bytes = 1.5 * static_cast<double>(set.upright.views.size()) * set.width * set.height;
    RS_ASSIGN_OR_RETURN(const engine::Renderer renderer, engine::Renderer::create(std::move(built.object)));
    RS_ASSIGN_OR_RETURN(const engine::Comparison comparison, engine::compare_with_set(renderer, held_out));
    const double share = static_cast<double>(file_bytes) / raw_bytes;
    std::printf("%.1f,%zu,%.2f,%zu,%.2f,%.2f\n", cell_px, file_bytes, 100 * share, memory_bytes,
                100 * static_cast<double>(memory_bytes) / raw_bytes, comparison.mean_psnr_db);
    std::fflush(stdout);
    return MapMeasurement{share, comparison.mean_psnr_db};
}

Status write_plot(const std::string& path, const std::vector<MapMeasurement>& measured) {
    LinePlot plot;
    plot.title = "Views held out against the size of the RS map";
    plot.x_label = "RS map in the file, % of the raw images (YUV 4:2:0)";
    plot.y_label = "mean PSNR, dB";
    plot.series.push_back({"cells of 12, 8, 6, 4.8, 3.2, 2.4 px", {}, {}});
    for (const MapMeasurement& point : measured) {
        plot.series[0].x.push_back(100 * point.share);
        plot.series[0].y.push_back(point.psnr_db);
    }
    const std::string svg = draw_standalone_svg(plot);
    return write_file(path, svg);
}

Status run(const Arguments& arguments) {
    RS_ASSIGN_OR_RETURN(const CaptureSet set, open_capture_set(arguments.set));
    std::printf("cell_px,file_bytes,file_percent,memory_bytes,memory_percent,psnr_db\n");
    std::vector<MapMeasurement> measured;
    for (const double cell_px : {12.0, 8.0, 6.0, 4.8, 3.2, 2.4, 2.0, 1.6}) {
        RS_ASSIGN_OR_RETURN(const MapMeasurement point, measure(set, arguments.held_out, cell_px));
        measured.push_back(point);
    }
    return arguments.plot.empty() ? Status{} : write_plot(arguments.plot, measured);
}

}  // namespace
}  // namespace rs::encode

int main(int argc, char** argv) {
    rs::encode::Arguments arguments;
    CLI::App app("Held-out PSNR over the size of the shape map.", "bench_map_size");
    app.add_option("SET", arguments.set, "capture set to build from")->required();
    app.add_option("HELD_OUT", arguments.held_out, "capture set to score on")->required();
    app.add_option("-o,--output", arguments.plot, "plot to write, SVG");
    app.footer("Example:\n  bench_map_size spot spot-halfway -o curve.svg");
    std::function<rs::Status()> run = [&] { return rs::encode::run(arguments); };
    return rs::tool_main(app, argc, argv, run);
}
