#include "capture/tools/commands.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/light/luminaire.hpp"
#include "rayspace/page/plots.hpp"
#include "rayspace/page/svg_parts.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

struct LuminaireCommandLine {
    std::filesystem::path file;
    std::filesystem::path plot;
    bool json = false;
};

const char* name_of(Goniometer type) {
    return type == Goniometer::kTypeA ? "A" : type == Goniometer::kTypeB ? "B" : "C";
}

struct Spreads {
    const char* side;  // "", or the side of a direct-indirect luminaire
    BeamSpread across, along;
};

// Spreads of the whole luminaire, or of each side of a direct-indirect one.
std::vector<Spreads> spreads_of(const PhotometricWeb& web) {
    const auto spreads = [&](const char* side, BeamPart part) {
        return Spreads{side, beam_spread(web, 0, part), beam_spread(web, 90, part)};
    };
    if (!is_direct_indirect(web)) return {spreads("", BeamPart::kWhole)};
    return {spreads("down", BeamPart::kTowardsAim), spreads("up", BeamPart::kOpposite)};
}

nlohmann::ordered_json json_of(const Luminaire& lamp, const std::vector<Spreads>& spreads) {
    nlohmann::ordered_json json;
    json["format"] = lamp.format;
    json["photometry"] = name_of(lamp.type);
    json["lumens"] = lamp.web.lumens();
    json["zonal_lumens"] = lamp.web.zonal_lumens();
    json["peak_cd"] = lamp.web.peak_candela();
    json["aim_cd"] = lamp.web.candela({0, -1, 0});
    const auto spread = [](const BeamSpread& s) {
        return nlohmann::ordered_json{{"beam_deg", degrees(s.beam_rad)}, {"field_deg", degrees(s.field_rad)}};
    };
    json["plane_0_180"] = spread(spreads.front().across);
    json["plane_90_270"] = spread(spreads.front().along);
    if (spreads.size() > 1) {
        json["up"] = {{"plane_0_180", spread(spreads.back().across)}, {"plane_90_270", spread(spreads.back().along)}};
    }
    json["lamps"] = lamp.lamps;
    json["lumens_per_lamp"] =
        lamp.lumens_per_lamp < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(lamp.lumens_per_lamp);
    json["input_w"] = lamp.input_w;
    json["opening"] = {{"shape", name_of(lamp.opening.shape)},
                       {"across_m", lamp.opening.across_m},
                       {"along_m", lamp.opening.along_m},
                       {"height_m", lamp.opening.height_m}};
    json["tilt_angles"] = lamp.tilt.angles_deg.size();
    json["keywords"] = nlohmann::ordered_json::array();
    for (const auto& [keyword, text] : lamp.keywords) json["keywords"].push_back({keyword, text});
    return json;
}

std::string title_of(const Luminaire& lamp, const std::filesystem::path& file) {
    const std::string& name = lamp.keyword("LUMCAT").empty() ? lamp.keyword("LUMINAIRE") : lamp.keyword("LUMCAT");
    return name.empty() ? file.filename().string() : name;
}

std::string one_decimal(double value) {
    return decimal(value, 1);
}

std::string lumens_line(const Luminaire& lamp) {
    std::string line = one_decimal(lamp.web.lumens()) + " lm, at most " + one_decimal(lamp.web.peak_candela()) + " cd";
    if (lamp.input_w > 0) {
        line += ", " + one_decimal(lamp.input_w) + " W (" + one_decimal(lamp.web.lumens() / lamp.input_w) + " lm/W)";
    }
    return line;
}

std::string label(const Spreads& part) {
    return *part.side == '\0' ? "" : std::string(" ") + part.side;
}

PolarPlot plot_of(const Luminaire& lamp, const std::vector<Spreads>& spreads, const std::string& title) {
    PolarPlot plot{title, "cd", {lumens_line(lamp)}, {}, 560};
    for (const Spreads& part : spreads) {
        plot.notes.push_back("beam " + one_decimal(degrees(part.across.beam_rad)) + "\xC2\xB0 x " +
                             one_decimal(degrees(part.along.beam_rad)) + "\xC2\xB0" + label(part));
    }
    for (const int plane : {0, 90}) {
        PolarCurve curve{"plane " + std::to_string(plane) + "-" + std::to_string(plane + 180), {}, {}};
        for (int step = -720; step <= 720; ++step) {
            curve.angle_rad.push_back(radians(step / 4.0));
            curve.radius.push_back(candela_in_plane(lamp.web, plane, curve.angle_rad.back()));
        }
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

Status run_luminaire(const LuminaireCommandLine& given) {
    if (Status kept = refuse_overwriting_inputs(given.plot, {given.file}); !kept) return kept;
    RS_ASSIGN_OR_RETURN(const Luminaire lamp, read_luminaire(given.file));
    const std::vector<Spreads> spreads = spreads_of(lamp.web);
    const std::string title = title_of(lamp, given.file);
    if (!given.plot.empty()) {
        if (Status written = write_file(given.plot, draw_standalone_svg(plot_of(lamp, spreads, title))); !written) {
            return written;
        }
    }
    if (given.json) {
        std::printf("%s\n", json_of(lamp, spreads).dump(2).c_str());
        return {};
    }
    std::printf("%s: %s, type %s: %s\n", given.file.string().c_str(), lamp.format.c_str(), name_of(lamp.type),
                title.c_str());
    std::printf("  %s; by zones %.2f lm\n", lumens_line(lamp).c_str(), lamp.web.zonal_lumens());
    for (const Spreads& part : spreads) {
        std::printf("  beam%s %.1f x %.1f degrees, field %.1f x %.1f (planes 0-180, 90-270)\n", label(part).c_str(),
                    degrees(part.across.beam_rad), degrees(part.along.beam_rad), degrees(part.across.field_rad),
                    degrees(part.along.field_rad));
    }
    std::printf("  opening: %s, %.3f x %.3f x %.3f m\n", name_of(lamp.opening.shape), lamp.opening.across_m,
                lamp.opening.along_m, lamp.opening.height_m);
    return {};
}

}  // namespace

void add_luminaire_command(CLI::App& app, std::function<Status()>& run) {
    auto given = std::make_shared<LuminaireCommandLine>();
    CLI::App* command = app.add_subcommand("luminaire", "Print the light distribution of a measured luminaire");
    command->add_option("FILE", given->file, "IES (LM-63, all editions) or EULUMDAT (.ldt) file")->required();
    command->add_flag("--json", given->json, "Print the results as JSON");
    command->add_option("-o,--output", given->plot, "Polar plot to write (.svg)")->check(ends_in({".svg"}));
    command->footer("Example: rs-capture luminaire downlight.ies -o downlight.svg");
    command->callback([given, &run] { run = [given] { return run_luminaire(*given); }; });
}

}  // namespace rs::capture
