#pragma once
// Memory budget with leases: memory is reserved before it is allocated and returned when the lease is destroyed.
// Thread-safe.

#include <cstdint>
#include <memory>
#include <optional>

namespace rs::compositor {

/// Reserved bytes, returned on destruction. Move-only; empty after a move.
class MemoryLease {
public:
    MemoryLease() = default;
    MemoryLease(MemoryLease&& other) noexcept;
    MemoryLease& operator=(MemoryLease&& other) noexcept;
    ~MemoryLease();

    [[nodiscard]] std::int64_t bytes() const { return bytes_; }
    /// Returns the excess over `bytes`, 0 .. bytes().
    void shrink(std::int64_t bytes);

private:
    friend class MemoryBudget;
    struct Account;
    MemoryLease(std::shared_ptr<Account> account, std::int64_t bytes);
    std::shared_ptr<Account> account_;
    std::int64_t bytes_ = 0;
};

/// Leases may outlive the budget.
class MemoryBudget {
public:
    explicit MemoryBudget(std::int64_t budget_bytes);

    /// \return nullopt if the budget would be exceeded.
    [[nodiscard]] std::optional<MemoryLease> reserve(std::int64_t bytes);

    [[nodiscard]] std::int64_t budget_bytes() const { return budget_bytes_; }
    [[nodiscard]] std::int64_t used_bytes() const;
    [[nodiscard]] std::int64_t peak_bytes() const;  // maximum of used_bytes() so far

private:
    std::int64_t budget_bytes_;
    std::shared_ptr<MemoryLease::Account> account_;
};

}  // namespace rs::compositor
