#pragma once
// Coin's state, which is one for the whole process: started once, used by one thread at a time. The files coin_session,
// graph and triangulate are the only ones that know Coin. Private to the VRML reader.

#include <mutex>
#include <string>

namespace rs::compositor::vrml {

// While it lives, this thread may use Coin. Not to be nested.
class CoinSession {
public:
    CoinSession();
    // The first complaint of Coin since the session began, on one line; empty where there is none.
    [[nodiscard]] static std::string complaint();

private:
    std::unique_lock<std::mutex> lock_;
};

}  // namespace rs::compositor::vrml
