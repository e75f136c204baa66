// A setup's text with its axes under other names: the same machine for all that NC words do not
// ask.
#pragma once

#include <map>
#include <string>

#include "tests/support/campaign.h"

namespace trunnion::campaign {

/// `names` by letter; in the chain, the axis tables, the errors and the calibration.
inline setup::Setup renamed(const setup::Setup& setup,
                            const std::map<std::string, std::string>& names) {
    std::string text = setup::format_setup(setup);
    const auto cut = [&](const std::string& title) {
        const auto at = text.find("\n[" + title + "]");
        if (at != std::string::npos) text.erase(at, text.find("\n[", at + 1) - at);
    };
    for (const char* title : {"control.parameters", "control.work_offsets"}) cut(title);
    const auto swap = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
            text.replace(at, from.size(), to), at += to.size();
    };
    const auto begin = text.find("chain = \"") + 9, end = text.find('"', begin);
    std::string chain = text.substr(begin, end - begin), other;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const auto it = names.find(std::string(1, chain[i]));
        other += it == names.end() ? std::string(1, chain[i]) : it->second;
    }
    text.replace(begin, end - begin, other);
    for (const auto& [letter, name] : names) {
        swap("[machine.axis." + letter + "]", "[machine.axis." + name + "]");
        for (const char direction : std::string("XYZABC"))
            for (const char* unit : {"_mm = ", "_rad = "})
                for (const char* zero : {"0", ""})
                    swap(std::string("\nE") + direction + zero + letter + unit,
                         std::string("\nE") + direction + zero + name + unit);
    }
    std::vector<std::string> notes;
    return setup::parse_setup(text, "renamed.toml", notes);
}

/// The table of a machine for the same machine under other names.
inline records::ReadingTable renamed(const records::ReadingTable& table, const setup::Setup& setup,
                                     const setup::Setup& other,
                                     const std::map<std::string, std::string>& names) {
    records::ReadingTable out = table;
    out.names = other.machine.chain.names();
    out.axes.clear();
    for (const kinematics::AxisGeometry& axis : other.machine.chain.axes())
        out.axes.push_back(axis.axis);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        out.rows[i].commanded = {};
        for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes()) {
            const auto it = names.find(axis.name);
            const auto slot = out.names.find(it == names.end() ? axis.name : it->second);
            out.rows[i].commanded[slot.value()] = table.rows[i].commanded[axis.axis];
        }
    }
    return out;
}

}  // namespace trunnion::campaign
