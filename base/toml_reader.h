// A TOML file as plain values with their positions, for messages.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/alarm.h"
#include "base/finite.h"

namespace trunnion::inline base {

struct TomlEntry;

struct TomlValue {
    enum class Kind : unsigned char { table, array, number, text, boolean };

    Kind kind = Kind::table;
    double number = 0.0;
    bool truth = false;
    std::string text;
    std::vector<TomlEntry> entries;  ///< of a table, in file order
    std::vector<TomlValue> items;    ///< of an array
    int line = 0, column = 0;
    mutable bool used = false;  ///< read by the program; unused keys are reported as unknown

    const TomlValue* find(std::string_view key) const;  ///< marks it as used; nullptr when absent
};

struct TomlEntry {
    std::string key;
    TomlValue value;
};

/// A parsed file. All functions that return a value throw InputError with its position when the
/// value has another type.
class TomlFile {
  public:
    /// Throws InputError (line, column, text of the line) for invalid TOML, and for a key of more
    /// than 64 parts (each is a level of tables).
    TomlFile(std::string text, std::string path);

    const TomlValue& root() const { return root_; }
    const std::string& path() const { return path_; }

    [[noreturn]] void fail(const TomlValue& at, const std::string& message) const;

    Finite number(const TomlValue& value) const;
    Finite positive(const TomlValue& value) const;
    const std::string& text(const TomlValue& value) const;
    Eigen::Vector3d vector3(const TomlValue& value) const;
    /// A number or an array of numbers.
    std::vector<double> numbers(const TomlValue& value) const;
    std::vector<std::string> texts(const TomlValue& value) const;
    const TomlValue& table(const TomlValue& value) const;

    /// `parent.key` when present.
    std::optional<Finite> find_number(const TomlValue& parent, std::string_view key) const;

    /// One line for each unused key.
    std::vector<std::string> unknown_keys() const;
    /// Throws InputError at the first unused key.
    void refuse_unknown_keys() const;

  private:
    SourceRef place(const TomlValue& value) const { return {path_, value.line, value.column}; }
    std::string line_text(int line) const;

    std::string text_, path_;
    TomlValue root_;
};

}  // namespace trunnion::inline base
