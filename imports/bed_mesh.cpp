#include "imports/bed_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/alarm.h"
#include "base/numbers.h"

namespace trunnion::imports {
namespace {

using Line = TextTable::Line;

/// Without the mark of saved values.
std::string_view bare(std::string_view line) {
    if (line.starts_with("#*#")) line.remove_prefix(3);
    return records::without_blanks(line);
}

/// One section of the file.
struct Mesh {
    int number = 0;  ///< line of the section
    std::vector<Line> rows;
    std::map<std::string, Line, std::less<>> values;
};

void take_line_of(Mesh& mesh, bool& in_points, std::string_view text, int number) {
    const std::size_t cut = text.find_first_of("=:");
    if (cut == std::string_view::npos) {
        if (in_points) mesh.rows.push_back({text, number});
        return;
    }
    const std::string key(records::without_blanks(text.substr(0, cut)));
    const std::string_view value = records::without_blanks(text.substr(cut + 1));
    in_points = key == "points";
    if (in_points && !value.empty()) mesh.rows.push_back({value, number});
    mesh.values[key] = {value, number};
}

/// The sections with points; one with the settings of the probing has none.
std::vector<Mesh> meshes_in(std::string_view text) {
    std::vector<Mesh> meshes;
    bool active = false, in_points = false;
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = bare(records::take_line(text));
        if (line.empty() || line.front() == '#' || line.front() == ';') continue;
        if (line.front() == '[') {
            active = line.starts_with("[bed_mesh");
            in_points = false;
            if (active) meshes.push_back({number, {}, {}});
        } else if (active) {
            take_line_of(meshes.back(), in_points, line, number);
        }
    }
    std::erase_if(meshes, [](const Mesh& mesh) { return mesh.rows.empty(); });
    return meshes;
}

class MeshReader {
  public:
    MeshReader(const Mesh& mesh, const std::string& path) : mesh_(mesh), path_(path) {
        if (mesh.rows.size() < 2 || numbers_of(mesh.rows.front()).size() < 2)
            fail({"", mesh.number}, "two rows and two columns of points are needed");
        count("x_count", numbers_of(mesh.rows.front()).size());
        count("y_count", mesh.rows.size());
    }

    std::vector<double> numbers_of(const Line& row) const {
        std::vector<double> list;
        std::string_view left = row.text;
        while (!left.empty()) {
            const std::size_t end = std::min(left.find(','), left.size());
            const auto value = parse_number(records::without_blanks(left.substr(0, end)));
            if (!value) fail(row, fmt::format("'{}' is not a number", left.substr(0, end)));
            list.push_back(*value);
            left.remove_prefix(std::min(end + 1, left.size()));
        }
        return list;
    }
    /// Coordinate of point k of `count` between the limits of this axis.
    double at(char axis, std::size_t k, std::size_t count) const {
        const double first = value(std::string("min_") + axis),
                     last = value(std::string("max_") + axis);
        return first + (last - first) * static_cast<double>(k) / static_cast<double>(count - 1);
    }
    [[noreturn]] void fail(const Line& line, const std::string& message) const {
        throw InputError(message, {path_, line.number, 1}, std::string(line.text));
    }

  private:
    double value(const std::string& key) const {
        const auto it = mesh_.values.find(key);
        const auto number = it == mesh_.values.end() ? std::nullopt : parse_number(it->second.text);
        if (!number) fail({"", mesh_.number}, "this mesh has no number " + key);
        return *number;
    }
    void count(const std::string& key, std::size_t found) const {
        const double told = value(key);
        if (told != static_cast<double>(found))
            fail(mesh_.rows.front(), fmt::format("{} is {}, but {} are here", key, told, found));
    }

    const Mesh& mesh_;
    const std::string& path_;
};

}  // namespace

bool is_bed_mesh(std::string_view text) {
    return text.find("[bed_mesh") != std::string_view::npos && !meshes_in(text).empty();
}

MadeTable bed_mesh_table(const ImportFile& file) {
    MadeTable table;
    for (const Mesh& mesh : meshes_in(file.text)) {
        const MeshReader reader(mesh, file.path);
        table.add("x nominal [mm];y nominal [mm];z nominal [mm];z measured [mm]", mesh.number);
        const std::size_t columns = reader.numbers_of(mesh.rows.front()).size();
        for (std::size_t j = 0; j < mesh.rows.size(); ++j) {
            const std::vector<double> z = reader.numbers_of(mesh.rows[j]);
            if (z.size() != columns)
                reader.fail(mesh.rows[j], fmt::format("{} points in this row, {} in the first one",
                                                      z.size(), columns));
            for (std::size_t i = 0; i < columns; ++i)
                table.add(fmt::format("{};{};0;{}", reader.at('x', i, columns),
                                      reader.at('y', j, mesh.rows.size()), z[i]),
                          mesh.rows[j].number);
        }
    }
    return table;
}

}  // namespace trunnion::imports
