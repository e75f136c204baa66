#include "setup/body_keys.h"

#include <algorithm>

#include "setup/toml_text.h"

namespace trunnion::setup {

namespace {

struct KindRow {
    const char* name;
    Body::Kind kind;
    bool has_size, has_wall;
};
constexpr KindRow kinds[] = {{"block", Body::Kind::block, true, false},
                             {"pocket", Body::Kind::pocket, true, true},
                             {"boss", Body::Kind::boss, false, false},
                             {"ring", Body::Kind::ring, false, true},
                             {"setter", Body::Kind::setter, false, false}};

const KindRow& row_of(Body::Kind kind) {
    return kinds[static_cast<std::size_t>(kind)];
}

const KindRow& read_kind(const TomlFile& file, const TomlValue& table) {
    const TomlValue* value = table.find("kind");
    if (!value) return kinds[0];
    for (const KindRow& row : kinds)
        if (file.text(*value) == row.name) return row;
    file.fail(*value, "kind is \"block\", \"pocket\", \"boss\", \"ring\" or \"setter\"");
}

void read_length(const TomlFile& file, const TomlValue& table, const char* key, bool belongs,
                 double& mm) {
    const TomlValue* value = table.find(key);
    if (!value) return;
    if (!belongs) file.fail(*value, std::string(key) + " does not belong to this kind");
    mm = file.positive(*value);
}

/// What a switch does to the reading; only a setter has a switch of its own.
void read_signal(const TomlFile& file, const TomlValue& table, Body& body) {
    const auto read = [&](const TomlValue* value, double& um) {
        if (!value) return;
        if (body.kind != Body::Kind::setter)
            file.fail(*value,
                      "pretravel_um and repeatability_um belong to a setter: [probe] has "
                      "those of the probe");
        um = file.number(*value);
    };
    read(table.find("pretravel_um"), body.pretravel_um);
    read(table.find("repeatability_um"), body.repeatability_um);
}

Body read_body(const TomlFile& file, const TomlValue& table, const Setup& setup) {
    Body body;
    const TomlValue* name = file.table(table).find("name");
    if (!name) file.fail(table, "this [[body]] has no name");
    body.name = file.text(*name);
    for (const Body& other : setup.bodies)
        if (other.name == body.name) file.fail(*name, "two bodies have this name");
    const KindRow& row = read_kind(file, table);
    body.kind = row.kind;
    const TomlValue* center = table.find("center_mm");
    if (!center) file.fail(table, "body " + body.name + " has no center_mm");
    body.center_W_mm = file.vector3(*center);
    if (const TomlValue* tilt = table.find("tilt_deg")) body.tilt_deg = file.vector3(*tilt);
    if (const TomlValue* size = table.find("size_mm")) {
        body.size_mm = file.vector3(*size);
        if (!row.has_size || !(body.size_mm.minCoeff() > 0.0))
            file.fail(*size, "size_mm, above 0, belongs to block and pocket");
    }
    read_length(file, table, "diameter_mm", !row.has_size, body.diameter_mm);
    read_length(file, table, "height_mm", !row.has_size, body.height_mm);
    read_length(file, table, "wall_mm", row.has_wall, body.wall_mm);
    read_signal(file, table, body);
    return body;
}

}  // namespace

void read_bodies(const TomlFile& file, Setup& setup) {
    const TomlValue* list = file.root().find("body");
    if (!list) return;
    if (list->kind != TomlValue::Kind::array) file.fail(*list, "write [[body]], twice in brackets");
    for (const TomlValue& item : list->items) setup.bodies.push_back(read_body(file, item, setup));
}

std::string body_text(const Body& body) {
    const KindRow& row = row_of(body.kind);
    std::string out = "\n[[body]]\nname = " + toml_quoted(body.name) +
                      "\nkind = " + toml_quoted(row.name) +
                      "\ncenter_mm = " + toml_numbers(body.center_W_mm) + '\n';
    if (!body.tilt_deg.isZero(0.0)) out += "tilt_deg = " + toml_numbers(body.tilt_deg) + '\n';
    if (row.has_size)
        out += "size_mm = " + toml_numbers(body.size_mm) + '\n';
    else
        out += "diameter_mm = " + toml_number(body.diameter_mm) +
               "\nheight_mm = " + toml_number(body.height_mm) + '\n';
    if (row.has_wall) out += "wall_mm = " + toml_number(body.wall_mm) + '\n';
    if (body.pretravel_um != 0.0) out += "pretravel_um = " + toml_number(body.pretravel_um) + '\n';
    if (body.repeatability_um != 0.0)
        out += "repeatability_um = " + toml_number(body.repeatability_um) + '\n';
    return out;
}

}  // namespace trunnion::setup
