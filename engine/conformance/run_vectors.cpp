#include "engine/conformance/run_vectors.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

namespace rs::engine {
namespace {

// Describes the difference to the expected view; "" if equal.
std::string difference(const ConformanceView& expected, const ExecutedView& found) {
    const ViewRegisters& r = expected.registers;
    if (found.image.width() != r.width || found.image.height() != r.height) {
        return "the image is " + std::to_string(found.image.width()) + "x" + std::to_string(found.image.height()) +
               " instead of " + std::to_string(r.width) + "x" + std::to_string(r.height);
    }
    if (const std::uint64_t hash = hash_of(found.image.view()); hash != expected.rgba_hash) {
        return "colours hash to " + hash_text(hash) + " instead of " + hash_text(expected.rgba_hash);
    }
    if (found.depth_q20.empty()) return "";
    if (const std::uint64_t hash = hash_of(found.depth_q20.view()); hash != expected.depth_hash) {
        return "depths hash to " + hash_text(hash) + " instead of " + hash_text(expected.depth_hash);
    }
    return "";
}

Status check_views(const ConformanceCase& test_case, const RaySpaceObject& object) {
    for (std::size_t v = 0; v < test_case.views.size(); ++v) {
        if (Status status = check_registers(object, test_case.views[v].registers); !status) {
            return Error{"case '" + test_case.name + "', view " + std::to_string(v) + ": " + status.error().message};
        }
    }
    return {};
}

CaseResult run_case(const ConformanceCase& test_case, const RaySpaceObject& object,
                    const Implementation& implementation, const std::filesystem::path& write_folder) {
    CaseResult result;
    const Result<ExecuteView> render = implementation.open(test_case, object);
    if (!render) {
        result.declined = render.error().message;
        return result;
    }
    for (std::size_t v = 0; v < test_case.views.size(); ++v) {
        const Result<ExecutedView> view = (*render)(v);
        if (!view) {
            result.declined = view.error().message;
            result.failed = result.same + result.different > 0;
            return result;
        }
        const std::string differs = difference(test_case.views[v], *view);
        ++(differs.empty() ? result.same : result.different);
        if (!differs.empty() && result.first.empty()) result.first = "view " + std::to_string(v) + ": " + differs;
        if (write_folder.empty()) continue;
        if (Status written = write_view_files(write_folder, test_case.name, v, *view); !written) {
            result.declined = written.error().message;
            result.failed = true;
            return result;
        }
    }
    return result;
}

constexpr std::uint64_t kBytesPerPixel = 4;  // both for colours and for depths

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& test_case, std::size_t view,
                              const char* ending) {
    return folder / test_case / (std::to_string(view) + ending);
}

Result<std::vector<std::byte>> read_sized(const std::filesystem::path& path, int width, int height) {
    const std::uint64_t expected =
        kBytesPerPixel * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    RS_ASSIGN_OR_RETURN(auto bytes, read_file(path, expected + 1));
    if (bytes.size() != expected) {
        return Error{path.string() + ": has " + std::to_string(bytes.size()) + " bytes; expected for a view of " +
                     std::to_string(width) + "x" + std::to_string(height) + ": " + std::to_string(expected)};
    }
    return std::vector<std::byte>(bytes.begin(), bytes.end());
}

}  // namespace

Implementation implementation_of(std::shared_ptr<Executor> executor) {
    const std::string name = executor->traits().name;
    return {name,
            [executor = std::move(executor)](const ConformanceCase& test_case,
                                             const RaySpaceObject& object) -> Result<ExecuteView> {
                RS_TRY(executor->supports(object));
                if (executor->as_rendered(object).images != object.images) {
                    return Error{"its alpha has values that " + executor->traits().name + " cannot store"};
                }
                RS_ASSIGN_OR_RETURN(const std::optional<int> slot, executor->load(object));
                if (!slot) return Error{"not enough memory in " + executor->traits().name};
                const std::shared_ptr<const int> loaded(new int(*slot), [executor](const int* held) {
                    static_cast<void>(executor->evict(*held));
                    delete held;
                });
                return ExecuteView([executor, loaded, &test_case](std::size_t v) -> Result<ExecutedView> {
                    const ViewRegisters& registers = test_case.views[v].registers;
                    RS_TRY(executor->can_render(registers));
                    RS_ASSIGN_OR_RETURN(std::vector<ExecutedView> drawn, executor->render({{*loaded, registers}}));
                    return std::move(drawn.front());
                });
            }};
}

Implementation implementation_in_files(const std::filesystem::path& folder) {
    return {"files:" + folder.filename().string(),
            [folder](const ConformanceCase& test_case, const RaySpaceObject&) -> Result<ExecuteView> {
                if (!std::filesystem::is_directory(folder / test_case.name)) {
                    return Error{(folder / test_case.name).string() + ": does not exist"};
                }
                return ExecuteView([folder, &test_case](std::size_t v) {
                    return read_view_files(folder, test_case.name, v, test_case.views[v].registers.width,
                                           test_case.views[v].registers.height);
                });
            }};
}

bool ConformanceMatrix::passed() const {
    std::vector<int> same(names.size());
    for (const auto& row : results) {
        for (std::size_t e = 0; e < row.size(); ++e) {
            if (row[e].different > 0 || row[e].failed) return false;
            same[e] += row[e].same;
        }
    }
    return std::all_of(same.begin(), same.end(), [](int views) { return views > 0; });
}

Result<ConformanceMatrix> run_vectors(const VectorSet& set, const std::vector<Implementation>& implementations,
                                      const std::filesystem::path& write_folder, Progress* progress) {
    ConformanceMatrix matrix;
    for (const Implementation& each : implementations) matrix.names.push_back(each.name);
    if (progress != nullptr) {
        progress->start("conformance", static_cast<std::int64_t>(set.cases.size() * implementations.size()));
    }
    for (const ConformanceCase& test_case : set.cases) {
        RS_ASSIGN_OR_RETURN(const RaySpaceObject object, read_object(set.folder / test_case.object, {.decode = false}));
        RS_TRY(check_views(test_case, object));
        std::vector<CaseResult>& row = matrix.results.emplace_back();
        for (std::size_t e = 0; e < implementations.size(); ++e) {
            row.push_back(
                run_case(test_case, object, implementations[e], e == 0 ? write_folder : std::filesystem::path()));
            if (progress != nullptr) progress->advance();
        }
    }
    if (progress != nullptr) progress->finish();
    return matrix;
}

Status write_view_files(const std::filesystem::path& folder, const std::string& test_case, std::size_t view,
                        const ExecutedView& executed) {
    std::error_code error;
    std::filesystem::create_directories(folder / test_case, error);
    if (error) return Error{(folder / test_case).string() + ": cannot create the folder: " + error.message()};
    ByteWriter colours;
    for (const Rgba8 p : executed.image.pixels()) {
        for (const std::uint8_t channel : {p.r, p.g, p.b, p.a}) colours.put(channel);
    }
    RS_TRY(write_file(file_of(folder, test_case, view, ".rgba"), colours.bytes()));
    if (executed.depth_q20.empty()) return {};
    ByteWriter depths;
    for (const std::int32_t depth : executed.depth_q20.pixels()) depths.put(depth);
    return write_file(file_of(folder, test_case, view, ".depth"), depths.bytes());
}

Result<ExecutedView> read_view_files(const std::filesystem::path& folder, const std::string& test_case,
                                     std::size_t view, int width, int height) {
    ExecutedView executed;
    RS_ASSIGN_OR_RETURN(const auto colours, read_sized(file_of(folder, test_case, view, ".rgba"), width, height));
    executed.image = Image<Rgba8>(width, height);
    ByteReader in(colours);
    for (Rgba8& p : executed.image.pixels()) {
        for (std::uint8_t* const channel : {&p.r, &p.g, &p.b, &p.a}) *channel = in.get<std::uint8_t>();
    }
    const std::filesystem::path depth_file = file_of(folder, test_case, view, ".depth");
    if (!std::filesystem::exists(depth_file)) return executed;
    RS_ASSIGN_OR_RETURN(const auto depths, read_sized(depth_file, width, height));
    executed.depth_q20 = Image<std::int32_t>(width, height);
    ByteReader from(depths);
    for (std::int32_t& depth : executed.depth_q20.pixels()) depth = from.get<std::int32_t>();
    return executed;
}

}  // namespace rs::engine
