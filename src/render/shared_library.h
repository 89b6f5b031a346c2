/// A shared library opened at run time.
#pragma once

#include <string>
#include <vector>

namespace mobbscope {

class SharedLibrary {
  public:
    /// Opens the first of `names` that there is. Throws std::runtime_error with the reason for each if there is none.
    explicit SharedLibrary(const std::vector<std::string>& names);
    ~SharedLibrary();
    SharedLibrary(const SharedLibrary&) = delete;
    SharedLibrary& operator=(const SharedLibrary&) = delete;

    /// The library's function of that name. Throws std::runtime_error if it has none.
    template <class Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(symbol(name));
    }

  private:
    void* symbol(const char* name) const;

    void* handle_ = nullptr;
    std::string name_;
};

}  // namespace mobbscope
