#pragma once
// Ranks as threads, which talk through queues: a farm without MPI.

#include "compositor/farm/schedule/transport.hpp"

#include <deque>
#include <map>
#include <mutex>
#include <utility>

namespace rs::farm::test {

class ThreadRanks {
public:
    explicit ThreadRanks(int ranks) : ranks_(ranks) {}

    class Rank final : public Transport {
    public:
        Rank(ThreadRanks& all, int rank) : all_(all), rank_(rank) {}
        [[nodiscard]] int rank() const override { return rank_; }
        [[nodiscard]] int ranks() const override { return all_.ranks_; }
        void send(int to, Channel channel, std::vector<std::uint8_t> bytes) override {
            const std::lock_guard lock(all_.mutex_);
            all_.queues_[{to, channel}].push_back({rank_, std::move(bytes)});
        }
        std::optional<Message> receive(Channel channel) override {
            const std::lock_guard lock(all_.mutex_);
            auto& queue = all_.queues_[{rank_, channel}];
            if (queue.empty()) return std::nullopt;
            Message message = std::move(queue.front());
            queue.pop_front();
            return message;
        }

    private:
        ThreadRanks& all_;
        int rank_;
    };

private:
    int ranks_;
    std::mutex mutex_;
    std::map<std::pair<int, Channel>, std::deque<Message>> queues_;
};

}  // namespace rs::farm::test
