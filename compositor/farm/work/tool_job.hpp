#pragma once
// An item that one of our tools does: `rs-encode build vase.set -o STAGED -q`, in a process of its own. The farm's
// results are a tool's own, byte for byte, for no other code makes them.
//
// In the item's folder (STATE/items/NAME) everything stands under its key, which is of the tool's version and arguments
// and of the names of files in the folder that is read:
//
//     KEY/out/NAME.rso   the result, until it is in the manifest and is renamed into place
//     KEY/inputs         what the tool has read (rayspace/file/input_list.hpp): is there when the work is complete
//     KEY/log            what it printed
//
// So whoever begins an item finds: a result in place or staged, made of the same files with the same options, and keeps
// it; else nothing, and does the work.

#include "compositor/farm/schedule/worker.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::farm {

struct ToolOrder {
    std::string tool;                    // "rs-encode"; stands beside this program
    std::vector<std::string> arguments;  // without the output
    std::string folder;                  // that is read and whose files count by name; empty: none
    std::string output;                  // absolute; a file or folder to be replaced whole
    std::string state;                   // the item's folder
};

nlohmann::json to_json(const ToolOrder& order);

struct ToolJobOptions {
    std::filesystem::path tools;  // the folder where they stand
    std::vector<int> processors;  // of each job; empty: those of this process
};

// For Worker. Fails inside of the outcome only; what the order states is looked up at once, which takes as long as
// reading the result of an earlier run does.
BeginJob begin_tool_jobs(const ToolJobOptions& options);

}  // namespace rs::farm
