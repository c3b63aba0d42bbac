#include "engine/conformance/vectors.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <xxhash.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <span>

namespace rs::engine {
namespace {

using nlohmann::json;

constexpr std::uint64_t kCap_bytes = std::uint64_t{64} << 20;

json json_of(const LinearForm& form) {
    return {form.at_origin, form.per_column, form.per_row};
}

LinearForm form_from(const json& numbers) {
    const auto at = [&](std::size_t i) { return numbers.at(i).get<std::int64_t>(); };
    return {at(0), at(1), at(2)};
}

json json_of(const ViewRegisters& r) {
    json planes = json::array();
    for (const PlaneRegisters& plane : r.planes) {
        planes.push_back({{"a", plane.a_q20},
                          {"c", plane.c_q20},
                          {"n", json_of(plane.along_normal)},
                          {"t", json_of(plane.along_tangent)}});
    }
    json registers = {{"width", r.width}, {"height", r.height},   {"ring", r.ring},
                      {"b", r.b_q20},     {"s", json_of(r.rise)}, {"planes", std::move(planes)}};
    if (r.filter != TexelFilter::kBilinear) registers["filter"] = static_cast<int>(r.filter);
    return registers;
}

ViewRegisters registers_from(const json& from) {
    ViewRegisters r;
    r.width = from.at("width").get<int>();
    r.height = from.at("height").get<int>();
    r.ring = from.at("ring").get<int>();
    r.filter = static_cast<TexelFilter>(from.value("filter", std::uint8_t{0}));
    r.b_q20 = from.at("b").get<std::int32_t>();
    r.rise = form_from(from.at("s"));
    for (const json& plane : from.at("planes")) {
        r.planes.push_back({plane.at("a").get<std::int32_t>(), plane.at("c").get<std::int32_t>(),
                            form_from(plane.at("n")), form_from(plane.at("t"))});
    }
    return r;
}

std::uint64_t hash_from(const json& text) {
    return std::stoull(text.get<std::string>(), nullptr, 16);
}

bool is_file_name(const std::string& name) {
    return !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string::npos;
}

// Describes the first defect of a case; "" if it is valid.
std::string defect_of(const ConformanceCase& c) {
    const bool plain = !c.name.empty() && std::all_of(c.name.begin(), c.name.end(), [](char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-';
    });
    if (!plain) return "must have a name of letters, digits and '-'";
    if (!is_file_name(c.object)) return "must name an object file in the folder";
    return c.views.empty() ? "has no views" : "";
}

}  // namespace

std::string hash_text(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

std::uint64_t hash_of(ConstImageView<Rgba8> image) {
    ByteWriter bytes;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const Rgba8 p = image(x, y);
            for (const std::uint8_t channel : {p.r, p.g, p.b, p.a}) bytes.put(channel);
        }
    }
    return XXH64(bytes.bytes().data(), bytes.size(), 0);
}

std::uint64_t hash_of(ConstImageView<std::int32_t> depth_q20) {
    ByteWriter bytes;
    for (int y = 0; y < depth_q20.height(); ++y) {
        for (int x = 0; x < depth_q20.width(); ++x) bytes.put(depth_q20(x, y));
    }
    return XXH64(bytes.bytes().data(), bytes.size(), 0);
}

Result<VectorSet> read_vectors(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / kVectorsFile;
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(file, kCap_bytes));
    VectorSet set;
    set.folder = folder;
    RS_ASSIGN_OR_RETURN(const json parsed,
                        parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string()));
    const json& root = parsed;
    try {
        const int version = root.at("version").get<int>();
        if (version != kVectorsVersion) {
            return Error{file.string() + ": has version " + std::to_string(version) +
                         "; supported version: " + std::to_string(kVectorsVersion)};
        }
        set.edition = root.at("edition").get<std::string>();
        for (const json& from : root.at("cases")) {
            ConformanceCase c;
            c.name = from.at("name").get<std::string>();
            c.covers = from.at("covers").get<std::string>();
            c.object = from.at("object").get<std::string>();
            for (const json& view : from.at("views")) {
                c.views.push_back({registers_from(view.at("registers")), hash_from(view.at("rgba")),
                                   hash_from(view.at("depth")), view.at("object_pixels").get<int>()});
            }
            if (const std::string defect = defect_of(c); !defect.empty()) {
                return Error{file.string() + ": case '" + c.name + "' " + defect};
            }
            set.cases.push_back(std::move(c));
        }
    } catch (const std::exception& e) {
        return Error{file.string() + ": not a list of conformance vectors: " + e.what()};
    }
    if (set.cases.empty()) return Error{file.string() + ": has no cases"};
    return set;
}

Status write_vectors(const VectorSet& set) {
    json cases = json::array();
    for (const ConformanceCase& c : set.cases) {
        json views = json::array();
        for (const ConformanceView& view : c.views) {
            views.push_back({{"registers", json_of(view.registers)},
                             {"rgba", hash_text(view.rgba_hash)},
                             {"depth", hash_text(view.depth_hash)},
                             {"object_pixels", view.object_pixels}});
        }
        cases.push_back({{"name", c.name}, {"covers", c.covers}, {"object", c.object}, {"views", std::move(views)}});
    }
    const json root = {{"version", kVectorsVersion}, {"edition", set.edition}, {"cases", std::move(cases)}};
    const std::string text = root.dump() + "\n";
    return write_file(set.folder / kVectorsFile, text);
}

}  // namespace rs::engine
