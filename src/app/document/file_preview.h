/// What the file under the cursor of the file dialog holds: read beside the window, one file at a time.
#pragma once

#include <app/document/job.h>
#include <scene/file_summary.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>

namespace mobbscope::app {

class FilePreview {
  public:
    /// Null until it is known. Call it in each frame: the file is read once it was asked for a moment long, and known
    /// until it changes. `now`: seconds of the window's clock; `wait`: the answer is waited for; `wake` is called from
    /// another thread when it is there.
    const FileSummary* ask(const std::filesystem::path& file, double now, bool wait, const std::function<void()>& wake);
    /// What is being read is given up: `wake` is not called any more.
    void end() { reading_.reset(); }
    /// In so many seconds it is worth asking again; infinity: `wake` will tell.
    double ask_again_in(double now) const;

  private:
    struct Known {
        std::uintmax_t size = 0;
        std::filesystem::file_time_type written{};
        FileSummary summary;
    };
    /// Waits for what is being read.
    void take_in();

    std::map<std::filesystem::path, Known> known_;
    std::unique_ptr<Job> reading_;
    std::filesystem::path asked_;
    double asked_at_ = 0;
};

}  // namespace mobbscope::app
