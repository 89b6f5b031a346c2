/// A list whose copies share their elements until one of them is changed.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace mobbscope {

/// A picture from another side has the disks of the one before, and the renderer knows them by their place. Not for
/// several threads that change one list.
template <class T>
class SharedValues {
  public:
    using value_type = T;
    using const_iterator = typename std::vector<T>::const_iterator;

    const_iterator begin() const { return values_->cbegin(); }
    const_iterator end() const { return values_->cend(); }
    std::size_t size() const { return values_->size(); }
    bool empty() const { return values_->empty(); }
    const T& operator[](std::size_t i) const { return (*values_)[i]; }
    const T& at(std::size_t i) const { return values_->at(i); }
    const T& front() const { return values_->front(); }
    const T& back() const { return values_->back(); }

    /// To change them: copies made before keep what they have.
    std::vector<T>& edit() {
        if (values_.use_count() != 1) values_ = std::make_shared<std::vector<T>>(*values_);
        return *values_;
    }

    /// Whether these are the very same elements. True holds as long as both exist, as neither is changed in place then.
    bool shares_with(const SharedValues& other) const { return values_ == other.values_; }

  private:
    std::shared_ptr<std::vector<T>> values_ = std::make_shared<std::vector<T>>();
};

}  // namespace mobbscope
