#include "compositor/viewer/residency/memory_budget.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

namespace rs::compositor {

struct MemoryLease::Account {
    std::mutex mutex;
    std::int64_t used = 0;
    std::int64_t peak = 0;

    void give_back(std::int64_t bytes) {
        const std::lock_guard lock(mutex);
        used -= bytes;
    }
};

MemoryLease::MemoryLease(std::shared_ptr<Account> account, std::int64_t bytes)
    : account_(std::move(account)), bytes_(bytes) {}

MemoryLease::MemoryLease(MemoryLease&& other) noexcept
    : account_(std::move(other.account_)), bytes_(std::exchange(other.bytes_, 0)) {}

MemoryLease& MemoryLease::operator=(MemoryLease&& other) noexcept {
    if (this != &other) {
        if (account_) account_->give_back(bytes_);
        account_ = std::move(other.account_);
        bytes_ = std::exchange(other.bytes_, 0);
    }
    return *this;
}

MemoryLease::~MemoryLease() {
    if (account_) account_->give_back(bytes_);
}

void MemoryLease::shrink(std::int64_t bytes) {
    RS_CHECK(bytes >= 0 && bytes <= bytes_);
    if (account_) account_->give_back(bytes_ - bytes);
    bytes_ = bytes;
}

MemoryBudget::MemoryBudget(std::int64_t budget_bytes)
    : budget_bytes_(budget_bytes), account_(std::make_shared<MemoryLease::Account>()) {}

std::optional<MemoryLease> MemoryBudget::reserve(std::int64_t bytes) {
    RS_CHECK(bytes >= 0);
    const std::lock_guard lock(account_->mutex);
    if (bytes > budget_bytes_ - account_->used) return std::nullopt;
    account_->used += bytes;
    account_->peak = std::max(account_->peak, account_->used);
    return MemoryLease(account_, bytes);
}

std::int64_t MemoryBudget::used_bytes() const {
    const std::lock_guard lock(account_->mutex);
    return account_->used;
}

std::int64_t MemoryBudget::peak_bytes() const {
    const std::lock_guard lock(account_->mutex);
    return account_->peak;
}

}  // namespace rs::compositor
