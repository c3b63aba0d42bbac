// Writes the golden files: `make_golden tests/reference/golden`. A golden file changes only with a written reason:
// after a format change, run it and update tests/reference/golden/README.md.
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/reference/golden_maker/golden_damage.hpp"
#include "tests/reference/golden_maker/golden_objects.hpp"
#include "tests/reference/golden_planes.hpp"

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

namespace {

namespace fs = std::filesystem;
using namespace rs;

std::string line_of(const std::string& file, std::size_t view, const golden::PlaneSums& sums) {
    std::string line = file + " " + std::to_string(view);
    for (const std::uint64_t sum : sums) {
        char text[18];
        std::snprintf(text, sizeof text, " %016" PRIx64, sum);
        line += text;
    }
    return line + "\n";
}

Result<golden::Draft> draft_of(const ContainerReader& file) {
    golden::Draft draft;
    for (const ChunkEntry& entry : file.table()) {
        auto payload = file.read(entry);
        if (!payload) return payload.error();
        draft.chunks.push_back({entry.name, entry.index, std::move(payload).value()});
    }
    return draft;
}

// Rewrites the file with plain line coding, which write_object() cannot select.
Status rewrite_with_plain_lines(const fs::path& path, const RaySpaceObject& object) {
    const auto file = ContainerReader::open(path);
    if (!file) return file.error();
    auto draft = draft_of(*file);
    if (!draft) return draft.error();
    for (std::uint32_t r = 0; r < object.rings.size(); ++r) {
        draft->payload(object_chunks::kRing, r) =
            object_chunks::ring_payload(object, r, object_chunks::LineCoding::kPlain);
    }
    return write_file(path, fuzz::container_of(draft->chunks));
}

using Drafts = std::map<std::string, golden::Draft>;

Status write_valid(const fs::path& folder, Drafts& drafts) {
    std::string text =
        "# FILE VIEW Y U V ALPHA: XXH64 (seed 0) of the planes' samples, row by row without gaps. U and V of coded\n"
        "# images are of full size, as they are decoded; of raw ones as the file holds them.\n";
    fs::create_directories(folder / "valid");
    for (const auto& [name, object, has_plain_lines] : golden::golden_objects()) {
        const fs::path path = folder / "valid" / (name + ".rso");
        if (Status status = write_object(path, object); !status) return status;
        if (has_plain_lines) {
            if (Status status = rewrite_with_plain_lines(path, object); !status) return status;
        }
        const auto file = ContainerReader::open(path);
        if (!file) return file.error();
        auto draft = draft_of(*file);
        if (!draft) return draft.error();
        drafts[name] = std::move(draft).value();
        const golden::FileSums sums = golden::reference_sums(*file);
        if (!sums.error.empty()) return Error{path.string() + ": " + sums.error};
        for (std::size_t v = 0; v < sums.views.size(); ++v) text += line_of(name + ".rso", v, sums.views[v]);
    }
    return write_file(folder / "planes.txt", std::as_bytes(std::span(text)));
}

Status write_invalid(const fs::path& folder, const Drafts& drafts) {
    std::string text =
        "# FILE; where the damage is: \"codec\" for the payload of CODE or of a coded PICT, else \"file\"; the valid\n"
        "# file that it was made of; and the words that a refusal by the library must contain, separated by \" | \".\n";
    std::vector<golden::Damage> damages = golden::container_damages();
    const auto add = [&](std::vector<golden::Damage> more) {
        for (golden::Damage& damage : more) damages.push_back(std::move(damage));
    };
    add(golden::order_damages());
    add(golden::geometry_damages());
    add(golden::shape_damages());
    add(golden::code_damages(drafts.at("dense-random-small"), drafts.at("dense-random-masks-small"),
                             drafts.at("board-random-small")));
    for (const char* base : {"dense-random-small", "board-random-small"}) {
        add(golden::image_damages(base, drafts.at(base)));
    }
    fs::create_directories(folder / "invalid");
    for (const golden::Damage& damage : damages) {
        golden::Draft draft = drafts.at(damage.base);
        damage.apply(draft);
        golden::Bytes bytes = fuzz::container_of(draft.chunks);
        if (draft.afterwards) draft.afterwards(bytes);
        const std::string name = damage.name + ".rso";
        if (Status status = write_file(folder / "invalid" / name, bytes); !status) return status;
        text += name + "; " + (damage.is_of_codec ? "codec" : "file") + "; " + damage.base + ".rso; " + damage.words;
        text += "\n";
    }
    return write_file(folder / "refusals.txt", std::as_bytes(std::span(text)));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 || argv[1][0] == '-') {
        std::fprintf(stderr, "usage: make_golden FOLDER\n");
        return 2;
    }
    Drafts drafts;
    Status status = write_valid(argv[1], drafts);
    if (status.ok()) status = write_invalid(argv[1], drafts);
    if (!status) std::fprintf(stderr, "make_golden: error: %s\n", status.error().message.c_str());
    return status.ok() ? 0 : 1;
}
