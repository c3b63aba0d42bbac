#include "engine/tools/commands.hpp"

#include "engine/conformance/run_vectors.hpp"
#include "engine/core/views/compare.hpp"
#include "rayspace/api/types/executor_table.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/format/object_file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

namespace rs::engine {
namespace {

struct ConformanceArguments {
    std::string target;
    std::vector<std::string> executors;
    std::string write_folder;
    int views = 40;
    std::uint64_t seed = 1;
    bool quiet = false;
    bool json = false;
};

Result<Implementation> implementation_from(const std::string& name) {
    constexpr std::string_view kFiles = "files:";
    if (name.starts_with(kFiles)) return implementation_in_files(name.substr(kFiles.size()));
    Result<std::unique_ptr<Executor>> executor = ExecutorTable().create(name);
    if (!executor) return Error{executor.error().message + " or files:FOLDER"};
    return implementation_of(std::move(*executor));
}

std::string cell_text(const CaseResult& result) {
    if (result.failed) return "failed";
    if (result.different > 0) return std::to_string(result.different) + " differ";
    if (!result.declined.empty()) return "-";
    return std::to_string(result.same) + " same";
}

void print_matrix(const VectorSet& set, const ConformanceMatrix& matrix) {
    std::printf("conformance set, edition %s: %zu cases\n%-20s", set.edition.c_str(), set.cases.size(), "");
    for (const std::string& name : matrix.names) std::printf(" %18s", name.c_str());
    std::printf("\n");
    for (std::size_t c = 0; c < set.cases.size(); ++c) {
        std::printf("%-20s", set.cases[c].name.c_str());
        for (const CaseResult& result : matrix.results[c]) std::printf(" %18s", cell_text(result).c_str());
        std::printf("\n");
    }
    for (std::size_t c = 0; c < set.cases.size(); ++c) {
        for (std::size_t e = 0; e < matrix.names.size(); ++e) {
            const CaseResult& result = matrix.results[c][e];
            const std::string why = result.different > 0 ? result.first : result.declined;
            if (!why.empty()) {
                std::printf("  %s, %s: %s\n", set.cases[c].name.c_str(), matrix.names[e].c_str(), why.c_str());
            }
        }
    }
}

void print_json(const VectorSet& set, const ConformanceMatrix& matrix) {
    nlohmann::json json{{"edition", set.edition}, {"passed", matrix.passed()}};
    for (std::size_t c = 0; c < set.cases.size(); ++c) {
        nlohmann::json row{{"case", set.cases[c].name}};
        for (std::size_t e = 0; e < matrix.names.size(); ++e) {
            const CaseResult& result = matrix.results[c][e];
            row["executors"][matrix.names[e]] = {{"same", result.same},
                                                 {"different", result.different},
                                                 {"declined", result.declined},
                                                 {"first", result.first}};
        }
        json["cases"].push_back(row);
    }
    std::cout << json.dump(2) << '\n';
}

Status run_set(const ConformanceArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const VectorSet set, read_vectors(arguments.target));
    std::vector<Implementation> implementations;
    for (const std::string& name :
         arguments.executors.empty() ? std::vector<std::string>{"scalar", "core"} : arguments.executors) {
        RS_ASSIGN_OR_RETURN(Implementation implementation, implementation_from(name));
        implementations.push_back(std::move(implementation));
    }
    ProgressBar progress(arguments.quiet);
    RS_ASSIGN_OR_RETURN(const ConformanceMatrix matrix,
                        run_vectors(set, implementations, arguments.write_folder, &progress));
    if (arguments.json) {
        print_json(set, matrix);
    } else {
        print_matrix(set, matrix);
    }
    if (matrix.passed()) return {};
    return Error{arguments.target + ": an implementation differs from the definition; see the table"};
}

Status run_random_views(const ConformanceArguments& arguments) {
    RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(arguments.target, {.decode = false}));
    ProgressBar progress(arguments.quiet);
    RS_ASSIGN_OR_RETURN(const ConformanceReport report,
                        check_conformance(std::move(object), arguments.views, arguments.seed, &progress));
    std::printf(
        "%s: %d views (%d upright, %d of them on a ring), %lld pixels, %lld of the object: %lld differ from the "
        "definition\n",
        arguments.target.c_str(), report.views, report.upright_views, report.on_ring_views,
        static_cast<long long>(report.pixels), static_cast<long long>(report.object_pixels),
        static_cast<long long>(report.different_pixels));
    if (report.different_pixels != 0) {
        return Error{arguments.target +
                     ": the core's images differ from the definition; this is a defect of the renderer"};
    }
    return {};
}

}  // namespace

void add_conformance_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<ConformanceArguments>();
    CLI::App* command = app.add_subcommand(
        "conformance",
        "Compare implementations with the definition bit for bit on the conformance set (a folder with a\n"
        "vectors.json), or the core on random views of an object");
    command->add_option("TARGET", arguments->target, "folder of the conformance set, or an object, .rso")->required();
    command->add_option("--executor", arguments->executors,
                        "with a set: " + ExecutorTable().names() +
                            " (CONFIG as in `simulate`), or files:FOLDER, images that another implementation wrote; "
                            "may be repeated; default: scalar and core");
    command->add_option(
        "--write", arguments->write_folder,
        "with a set: also write the views of the first executor to this folder, in the format of files:FOLDER");
    command->add_option("--views", arguments->views, "with an object: number of views")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_option("--seed", arguments->seed, "with an object: seed of the random views")->capture_default_str();
    command->add_flag("-q,--quiet", arguments->quiet, "no progress bar");
    command->add_flag("--json", arguments->json, "with a set: print the table as JSON");
    command->footer(
        "Examples:\n  rs-engine conformance engine/conformance/vectors --executor core --executor "
        "board:prototype-2000\n"
        "  rs-engine conformance engine/conformance/vectors --executor files:my-images\n"
        "  rs-engine conformance vase.rso --views 100");
    command->callback([arguments, &run] {
        run = [arguments] {
            return std::filesystem::is_directory(arguments->target) ? run_set(*arguments)
                                                                    : run_random_views(*arguments);
        };
    });
}

}  // namespace rs::engine
