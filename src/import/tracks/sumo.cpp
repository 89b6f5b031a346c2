#include <import/tracks/rows.h>
#include <import/tracks/sumo.h>
#include <import/tracks/xml_text.h>
#include <mobb/clip.h>

#include <algorithm>
#include <iterator>

namespace mobbscope {

namespace {

constexpr double kMostSaid = 1073741824;  // metres: so far off SUMO puts what has no place

/// Attributes of who is there.
struct FcdColumn {
    const char* attribute;
    Column column;
    bool must_be = false;
};
constexpr FcdColumn kFcdColumns[] = {
    {"id", Column::id, true},   {"x", Column::x, true},   {"y", Column::y, true}, {"type", Column::label},
    {"length", Column::length}, {"width", Column::width}, {"z", Column::z},       {"angle", Column::heading},
};
constexpr std::size_t kFcdTime = std::size(kFcdColumns), kFcdVehicle = kFcdTime + 1;  // columns beyond those

class FcdRows final : public Cells {
  public:
    FcdRows(std::string_view text, const std::string& file) : Cells(file), xml_(text, file), rows_(file) {}

    TrackFile read() {
        for (const std::string_view kind : kSumoKinds) {
            if (kind != kSumoKinds[0]) rows_.begin_group();
            choose_columns(kind);
        }
        for (const pugi::xml_node step : xml_.root().children("timestep")) {
            const std::string_view said = xml_.text(step, "time");
            if (said.find(':') != std::string_view::npos)
                xml_.fail(step,
                          "time is " + in_quotes(said) + ", a time of day; run SUMO without --human-readable-time");
            time_ = xml_.number(step, "time", mobb::kMaxTime);
            for (who_ = step.first_child(); who_; who_ = who_.next_sibling()) {
                const auto* const kind = std::ranges::find(kSumoKinds, std::string_view(who_.name()));
                if (kind != std::end(kSumoKinds)) rows_.add(*this, static_cast<std::size_t>(kind - kSumoKinds));
            }
        }
        if (rows_.empty()) xml_.fail(xml_.root(), "nobody has a place in any timestep; let SUMO write x and y");
        TrackFile out = rows_.finish();
        out.format = "sumo";
        out.place_is_front = true;
        return out;
    }

    double number(std::size_t column) const override {
        return column == kFcdTime ? time_ : xml_.number(who_, kFcdColumns[column].attribute, kMostSaid);
    }
    std::string_view text(std::size_t column) const override {
        return column == kFcdTime            ? ""
               : column == kFcdVehicle       ? who_.attribute("vehicle").value()
               : kFcdColumns[column].must_be ? xml_.text(who_, kFcdColumns[column].attribute)
                                             : who_.attribute(kFcdColumns[column].attribute).value();
    }
    bool is_empty(std::size_t column) const override { return column < kFcdTime && text(column).empty(); }
    int line() const override { return xml_.line_of(who_); }
    std::string place(std::size_t) const override { return at_line(line()) + ", <" + who_.name() + ">"; }

  private:
    void choose_columns(std::string_view kind) {
        rows_.group().kind = kind;
        rows_.group().vehicle = kFcdVehicle;
        rows_[Column::t].emplace(kFcdTime);
        for (std::size_t at = 0; at < std::size(kFcdColumns); ++at) rows_[kFcdColumns[at].column].emplace(at);
        // SUMO's angles are clockwise from north.
        std::vector<std::string> names;
        for (const FcdColumn& column : kFcdColumns) names.emplace_back(column.attribute);
        rows_[Column::heading].emplace("90-angle", names);
        rows_.body_columns = "the attributes length and width";
        rows_.heading_column = "the attribute angle";
    }

    mutable XmlText xml_;
    RowReader rows_;
    pugi::xml_node who_;
    double time_ = 0;  ///< of the step
};

}  // namespace

bool looks_like_sumo(std::string_view text) { return xml_root(text) == "fcd-export"; }

TrackFile parse_sumo(std::string_view text, const std::string& file) { return FcdRows(text, file).read(); }

}  // namespace mobbscope
