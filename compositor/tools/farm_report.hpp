#pragma once
// What rs-farm reports: one line on stderr while all ranks work, a table on stdout at the end.

#include "compositor/farm/schedule/coordinator.hpp"

#include <string>
#include <vector>

namespace rs::farm {

class FarmProgress {
public:
    explicit FarmProgress(bool quiet);
    // Draws where it is time to: in place twice a second on a terminal, else a line at every tenth, and every half
    // minute.
    void show(const Standing& standing, const std::vector<Item>& items);
    // Ends the line.
    void finish();

private:
    bool quiet_;
    bool terminal_;
    bool drawn_ = false;
    double last_s_ = 0;
    int last_tenth_ = 0;
};

// What failed and why, what each rank did, and all in all.
std::string table_of(const Standing& standing, const std::vector<Item>& items);
// The same for programs.
std::string json_of(const Standing& standing, const std::vector<Item>& items);

}  // namespace rs::farm
