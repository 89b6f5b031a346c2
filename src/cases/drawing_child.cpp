#include <base/error.h>
#include <base/json.h>
#include <base/process.h>
#include <base/text.h>
#include <cases/drawing_child.h>
#include <cases/result_line.h>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kAskEvery(50);
constexpr std::size_t kMostComplaint = 4096;   // bytes that are kept of standard error
constexpr std::size_t kMostLine = 1ull << 30;  // bytes of a result
constexpr double kPatienceWithItsEnd = 5;      // seconds, of a process that has nothing left to do
constexpr double kPatienceWithItsStart = 60;   // seconds, until it has opened OpenGL

/// Of a case that cannot be read the default: what is wrong is told where it is drawn.
double time_limit_of(const CaseOrder& order) {
    try {
        return read_terms(order.file, order.options.asked).time_limit;
    } catch (const InputError&) {
        return CaseTerms{}.time_limit;
    }
}

CaseResult failed(const CaseFile& file, std::string why) {
    CaseResult out;
    out.file = file;
    out.outcome = CaseOutcome::failed;
    out.message = std::move(why);
    return out;
}

/// Of a case that the machine kept from being drawn: nothing is known of it.
CaseResult not_drawn(const CaseFile& file, std::string why) {
    CaseResult out = failed(file, why);
    out.outcome = CaseOutcome::skipped;
    out.not_drawn = std::move(why);
    return out;
}

/// A process that draws one case after the other.
class CaseProcess {
  public:
    CaseProcess(const CaseDrawer& drawer, const std::filesystem::path& folder)
        // Names of folders may begin as options do.
        : process_(drawer.program, {"test", "--backend", drawer.backend, "--requests", "--", folder.string()},
                   {talk_.there.get(), talk_.there.get(), complaints_.there.get()}) {
        talk_.there.close();
        complaints_.there.close();
    }

    bool is_idle() const { return order_ == nullptr; }
    void ask(const CaseOrder& order) {
        order_ = &order;
        begun_ = Clock::now();
        complaint_.clear();
        limit_ = time_limit_of(order);
        // One that cannot hear it any more has ended, which is seen in time.
        send_all(talk_.here, request_line({order.file.name, order.options}));
    }

    void add_to(std::vector<pollfd>& wanted) const {
        for (const Connection* from : {&talk_, &complaints_}) wanted.push_back({from->here.get(), POLLIN, 0});
    }

    /// What came of the case that was asked for, once that is known; never waits.
    std::optional<CaseResult> answer() {
        const bool has_ended = process_.ended().has_value();
        read(has_ended);
        if (std::optional<CaseResult> result = answer_in_line()) return result;
        if (is_idle() || is_over_) return std::nullopt;
        const CaseFile& file = order_->file;
        if (has_ended) return over(failed(file, how_it_ended_here()));
        if (said_.size() > kMostLine)
            return over(failed(file, "the drawing process wrote something that is not a result"));
        if (seconds() <= (is_ready_ ? limit_ : kPatienceWithItsStart)) return std::nullopt;
        if (is_ready_) return over(failed(file, "took longer than " + brief(limit_) + " s (time_limit)"));
        return over(not_drawn(file, "OpenGL did not start within " + brief(kPatienceWithItsStart) + " s"));
    }

    /// Until it says something, or a while.
    void wait() const {
        std::vector<pollfd> wanted;
        add_to(wanted);
        ::poll(wanted.data(), wanted.size(), static_cast<int>(kAskEvery.count()));
    }

    /// Whether it draws no more.
    bool is_over() { return is_over_ || (is_idle() && process_.ended()); }

    /// There will be no more cases.
    void let_end() const {
        if (talk_.here.is_open()) send_end(talk_.here);
    }
    /// What went wrong after its last case; empty if nothing did. Waits until it has ended, but not long.
    std::string end() {
        if (is_over_) return "";
        let_end();
        const std::optional<int> status = process_.wait(kPatienceWithItsEnd);
        read(true);
        if (status == 0) return "";
        return "after its last case: " + (status ? how_it_ended_here() : "the process that draws did not end");
    }

  private:
    /// Some of what has come, or all.
    void read(bool all) {
        std::size_t before = 0;
        do {
            before = said_.size();
            if (talk_.here.is_open() && !read_some(talk_.here, said_)) talk_.here.close();
            if (complaints_.here.is_open() && !read_some(complaints_.here, complaint_)) complaints_.here.close();
            if (complaint_.size() > kMostComplaint) complaint_.resize(kMostComplaint);
        } while (all && said_.size() > before && said_.size() <= kMostLine);
    }

    std::optional<CaseResult> answer_in_line() {
        if (is_idle() || is_over_) return std::nullopt;
        if (!is_ready_ && !said_.empty()) {
            // An empty line says that it can draw; from then on the case takes its time.
            is_ready_ = true;
            begun_ = Clock::now();
            if (said_.front() == '\n') said_.erase(0, 1);
        }
        const std::size_t end = said_.find('\n', looked_at_);
        looked_at_ = said_.size();
        if (end == std::string::npos) return std::nullopt;
        const CaseFile& file = order_->file;
        try {
            CaseResult result = read_result_line(std::string_view(said_).substr(0, end), {file});
            said_.erase(0, end + 1);
            looked_at_ = 0;
            order_ = nullptr;
            return result;
        } catch (const InputError&) {
            return over(failed(file, "the drawing process wrote something that is not a result"));
        }
    }

    double seconds() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }

    CaseResult over(CaseResult result) {
        process_.kill();
        is_over_ = true;
        result.seconds = seconds();
        return result;
    }

    /// Its own first line that is no warning; else the first, which a library said.
    std::string_view first_complaint() const {
        std::string_view first;
        for (std::string_view rest = complaint_; !rest.empty();) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            const std::string_view line = trimmed(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
            if (first.empty()) first = line;
            if (line.starts_with("mobbscope: ") && !line.starts_with("mobbscope: warning: ")) return line;
        }
        return first;
    }
    std::string how_it_ended_here() {
        const int status = process_.ended().value_or(0);
        std::string out = WIFSIGNALED(status) ? "" : "the process that draws ";
        out += how_it_ended(status);
        if (const std::string_view first = first_complaint(); !first.empty()) out += " (" + cleaned(first) + ")";
        return out;
    }

    Connection talk_ = Connection::make();
    Connection complaints_ = Connection::make();
    Process process_;
    const CaseOrder* order_ = nullptr;  ///< that is being drawn
    Clock::time_point begun_;
    double limit_ = 0;  ///< seconds
    std::string said_, complaint_;
    std::size_t looked_at_ = 0;  ///< of what it said, to here there is no end of a line
    bool is_ready_ = false;      ///< it has opened OpenGL
    bool is_over_ = false;
};

/// The orders in turn, but for those that cannot be drawn, of which it tells at once.
class OrderQueue {
  public:
    OrderQueue(std::span<const CaseOrder> orders, const std::function<void(const CaseResult&)>& tell)
        : left_(orders), tell_(tell) {}

    /// Null: there are no more.
    const CaseOrder* next() {
        while (!left_.empty()) {
            const CaseOrder& order = left_.front();
            left_ = left_.subspan(1);
            const CaseFile& file = order.file;
            std::error_code ignored;
            if (!std::filesystem::exists(file.file, ignored)) {
                tell_(failed(file, file.file.string() + " is gone; draw all again"));
            } else if (!is_utf8(file.name)) {
                // Of one whose name is no text no line could tell.
                tell_(failed(file, file.file.string() + ": the name is not UTF-8; rename the file"));
            } else {
                return &order;
            }
        }
        return nullptr;
    }
    bool is_empty() const { return left_.empty(); }

  private:
    std::span<const CaseOrder> left_;
    const std::function<void(const CaseResult&)>& tell_;
};

class CaseProcesses {
  public:
    CaseProcesses(const CaseDrawer& drawer, const std::filesystem::path& folder, std::span<const CaseOrder> orders,
                  const std::function<void(const CaseResult&)>& tell)
        : drawer_(drawer),
          folder_(folder),
          most_(static_cast<std::size_t>(drawer.jobs > 0 ? drawer.jobs : default_jobs())),
          queue_(orders, tell),
          tell_(tell) {}

    /// Whether there is still something to be drawn.
    bool work() {
        for (const auto& process : at_work_) {
            if (const std::optional<CaseResult> result = process->answer()) told(*result);
        }
        std::erase_if(at_work_, [&](const auto& process) {
            if (!process->is_over()) return false;
            complain(process->end());
            return true;
        });
        for (const auto& process : at_work_) {
            if (!process->is_idle()) continue;
            if (const CaseOrder* order = queue_.next()) process->ask(*order);
        }
        while (at_work_.size() < most_ && !queue_.is_empty() && start()) {
            if (const CaseOrder* order = queue_.next()) at_work_.back()->ask(*order);
        }
        return !queue_.is_empty() || std::ranges::any_of(at_work_, [](const auto& one) { return !one->is_idle(); });
    }

    /// Until one says something, or a while.
    void wait() const {
        std::vector<pollfd> wanted;
        for (const auto& process : at_work_) process->add_to(wanted);
        ::poll(wanted.data(), wanted.size(), static_cast<int>(kAskEvery.count()));
    }

    std::vector<std::string> end() {
        for (const auto& process : at_work_) process->let_end();
        for (const auto& process : at_work_) complain(process->end());
        return std::move(complaints_);
    }

  private:
    /// False: no more than there are.
    bool start() {
        try {
            at_work_.push_back(std::make_unique<CaseProcess>(drawer_, folder_));
            return true;
        } catch (const MachineError& error) {
            const std::string why = std::string("no process that draws can be started: ") + error.what();
            if (at_work_.empty() && !has_told_) throw MachineError(why);
            // Fewer do; without any, each case tries anew.
            most_ = std::max<std::size_t>(at_work_.size(), 1);
            const CaseOrder* order = at_work_.empty() ? queue_.next() : nullptr;
            if (order) told(not_drawn(order->file, why));
            return false;
        }
    }
    void told(const CaseResult& result) {
        has_told_ = true;
        tell_(result);
    }
    void complain(std::string complaint) {
        if (!complaint.empty()) complaints_.push_back(std::move(complaint));
    }

    const CaseDrawer& drawer_;
    const std::filesystem::path& folder_;
    std::size_t most_;  ///< at a time
    OrderQueue queue_;
    const std::function<void(const CaseResult&)>& tell_;
    std::vector<std::unique_ptr<CaseProcess>> at_work_;
    std::vector<std::string> complaints_;
    bool has_told_ = false;
};

}  // namespace

int default_jobs() {
    constexpr int kMost = 8;  // each takes some 250 MB, and Mesa draws with threads of its own
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMost);
}

std::vector<std::string> draw_cases(const CaseDrawer& drawer, const std::filesystem::path& folder,
                                    std::span<const CaseOrder> orders,
                                    const std::function<void(const CaseResult&)>& tell,
                                    const std::function<void()>& go_on) {
    CaseProcesses processes(drawer, folder, orders, tell);
    while (processes.work()) {
        go_on();
        processes.wait();
    }
    return processes.end();
}

struct LastingDrawer::Work {
    Work(CaseDrawer with, std::filesystem::path of) : drawer(std::move(with)), folder(std::move(of)) {}

    CaseDrawer drawer;
    std::filesystem::path folder;
    std::optional<CaseProcess> process;
};

LastingDrawer::LastingDrawer(CaseDrawer drawer, std::filesystem::path folder)
    : work_(std::make_unique<Work>(std::move(drawer), std::move(folder))) {}

LastingDrawer::~LastingDrawer() {
    if (work_->process) work_->process->end();
}

CaseResult LastingDrawer::draw(const CaseOrder& order) {
    std::optional<CaseProcess>& process = work_->process;
    try {
        if (!process || process->is_over()) process.emplace(work_->drawer, work_->folder);
    } catch (const MachineError& error) {
        process.reset();
        return failed(order.file, std::string("no process that draws can be started: ") + error.what());
    }
    process->ask(order);
    for (;;) {
        if (std::optional<CaseResult> result = process->answer()) return std::move(*result);
        process->wait();
    }
}

std::string test_command_line(const CaseDrawer& drawer, const std::filesystem::path& folder, const std::string& name) {
    std::string out = "mobbscope test";
    if (drawer.backend != "auto") out += " --backend " + drawer.backend;
    if (folder.string().starts_with('-') || name.starts_with('-')) out += " --";
    return out + ' ' + shell_word(folder.string()) + ' ' + shell_word(name);
}

}  // namespace mobbscope::picture_tests
