#include <paper_tables/table_report.h>

#include <utility>

namespace mobbscope {

namespace {

using NamedRow = std::pair<std::string_view, PaperRow>;

constexpr NamedRow kTable1[] = {
    {"mobb_1level", {4.6, 0.45, 0, 10.3}}, {"umobb_1level", {4.5, 0, 0.45, 10.0}}, {"mobb", {2.3, 1.7, 0, 0.91}},
    {"umobb", {2.2, 0.16, 1.53, 0.77}},    {"hybrid1", {2.1, 0.40, 1.34, 0.77}},   {"hybrid2", {2.0, 1.5, 0.25, 0.81}},
};

constexpr NamedRow kTable2[] = {
    {"mobb_1level", {68.3, 0.83, 0, 306}}, {"umobb_1level", {68.1, 0, 0.83, 307}}, {"mobb", {5.9, 27.5, 0, 4.15}},
    {"umobb", {6.8, 0.62, 21.6, 3.10}},    {"hybrid1", {6.8, 1.45, 20.8, 3.10}},   {"hybrid2", {6.0, 26.7, 0.83, 4.15}},
};

template <std::size_t N>
std::optional<PaperRow> find(const NamedRow (&rows)[N], std::string_view method) {
    for (const auto& [name, row] : rows) {
        if (name == method) return row;
    }
    return std::nullopt;
}

}  // namespace

std::optional<PaperRow> paper_row(std::string_view table, std::string_view method) {
    if (table == "table1") return find(kTable1, method);
    if (table == "table2") return find(kTable2, method);
    return std::nullopt;
}

}  // namespace mobbscope
