#pragma once
// A virtual display for tests that open windows: starts Xvfb and sets DISPLAY.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

namespace rs::test {

/// -noreset: otherwise the server restarts when its last client disconnects, and rejects new clients meanwhile.
class VirtualDisplay {
public:
    VirtualDisplay() {
        int numbers[2];
        if (pipe(numbers) != 0) return;
        child_ = fork();
        if (child_ == 0) {
            close(numbers[0]);
            const int nothing = open("/dev/null", O_WRONLY);
            dup2(nothing, STDERR_FILENO);
            const std::string to = std::to_string(numbers[1]);
            execlp("Xvfb", "Xvfb", "-displayfd", to.c_str(), "-screen", "0", "1280x900x24", "-nolisten", "tcp",
                   "-noreset", static_cast<char*>(nullptr));
            _exit(127);
        }
        close(numbers[1]);
        std::string number;  // Xvfb writes the display's number and a newline when it is ready
        for (char c = 0; read(numbers[0], &c, 1) == 1 && c != '\n';) number += c;
        close(numbers[0]);
        if (number.empty()) return;
        setenv("DISPLAY", (":" + number).c_str(), 1);
        ready_ = true;
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;
    ~VirtualDisplay() {
        if (child_ <= 0) return;
        kill(child_, SIGTERM);
        waitpid(child_, nullptr, 0);
    }

    /// False if Xvfb is not installed.
    [[nodiscard]] bool ready() const { return ready_; }

private:
    pid_t child_ = -1;
    bool ready_ = false;
};

}  // namespace rs::test
