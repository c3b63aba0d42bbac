#pragma once
// Runs a tool as a child process and captures its output.

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace rs::test {

struct ToolRun {
    int exit_code = -1;  // 128 + signal if a signal ended it
    std::string out;
    std::string err;
};

inline std::string quoted(const std::string& argument) {
    std::string result = "'";
    for (const char c : argument) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

/// `scratch` is a folder for the captured output.
inline ToolRun run_program(const std::filesystem::path& scratch, const std::string& program,
                           const std::vector<std::string>& arguments) {
    std::string command = quoted(program);
    for (const std::string& argument : arguments) command += " " + quoted(argument);
    const auto out = scratch / "stdout.txt";
    const auto err = scratch / "stderr.txt";
    command += " >" + quoted(out.string()) + " 2>" + quoted(err.string()) + " </dev/null";
    const int status = std::system(command.c_str());
    const auto text = [](const std::filesystem::path& path) {
        std::ifstream file(path);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    ToolRun run;
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.out = text(out);
    run.err = text(err);
    return run;
}

inline ToolRun run_tool(const std::filesystem::path& scratch, const std::string& tool,
                        const std::vector<std::string>& arguments) {
    return run_program(scratch, std::string(RAYSPACE_TOOLS_DIR) + "/" + tool, arguments);
}

}  // namespace rs::test
