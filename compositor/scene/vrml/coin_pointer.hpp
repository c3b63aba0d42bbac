#pragma once
// A reference to a node that Coin counts. Only for the sources that know Coin.

namespace rs::compositor::vrml {

template <class T>
class CoinPointer {
public:
    explicit CoinPointer(T* node) : node_(node) {
        if (node_ != nullptr) node_->ref();
    }
    CoinPointer(const CoinPointer&) = delete;
    CoinPointer& operator=(const CoinPointer&) = delete;
    ~CoinPointer() {
        if (node_ != nullptr) node_->unref();
    }
    T* operator->() const { return node_; }
    [[nodiscard]] T* get() const { return node_; }

private:
    T* node_;
};

}  // namespace rs::compositor::vrml
