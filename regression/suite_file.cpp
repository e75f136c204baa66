// Suite files and folders as lists of cases.
#include <algorithm>
#include <filesystem>
#include <set>

#include "base/read_file.h"
#include "base/toml_reader.h"
#include "base/units.h"
#include "interpreter/program_folders.h"
#include "regression/suite.h"

namespace trunnion::regression {

namespace fs = std::filesystem;

namespace {

bool is_program(const fs::path& path) {
    if (path.has_extension()) return interpreter::has_program_ending(path.string());
    const std::string name = path.filename().string();  // O1234
    return name.size() > 1 && (name[0] == 'O' || name[0] == 'o') &&
           std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// `*` matches any characters, `?` one. After a mismatch only the last `*` is extended; the earlier
/// ones need no change, so the time is at most pattern times name.
bool matches(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0, behind_star = std::string_view::npos, star_to = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            behind_star = ++p;
            star_to = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p, ++n;
        } else {
            if (behind_star == std::string_view::npos) return false;
            p = behind_star;
            n = ++star_to;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool is_regular(const fs::directory_entry& entry) {
    std::error_code unknown;  // a circular link
    return entry.is_regular_file(unknown);
}

/// True when a golden of this name is inside its folder.
bool stays_inside(const std::string& name) {
    const fs::path path = fs::path(name).lexically_normal();
    return !name.empty() && path.is_relative() && *path.begin() != "..";
}

class SuiteReader {
  public:
    SuiteReader(const TomlFile& file, const SuiteCase& like)
        : file_(file), folder_(fs::path(file.path()).parent_path()), like_(like) {}

    Suite read() {
        suite_.name = file_.path();
        const TomlValue* schema = file_.root().find("schema");
        if (schema == nullptr || file_.text(*schema) != "trunnion.suite/1")
            file_.fail(schema != nullptr ? *schema : file_.root(),
                       "a suite begins with schema = \"trunnion.suite/1\"");
        read_options(file_.root(), like_);
        if (const TomlValue* cases = file_.root().find("case"))
            for (const TomlValue& c : cases->items) read_case(c);
        if (const TomlValue* expected = file_.root().find("expected"))
            for (const TomlValue& e : expected->items) read_expected(e);
        if (suite_.cases.empty()) file_.fail(file_.root(), "the suite has no [[case]]");
        return std::move(suite_);
    }

  private:
    std::string path_of(const std::string& name) const { return (folder_ / name).generic_string(); }

    std::string text_or(const TomlValue& table, const char* key,
                        const std::string& otherwise) const {
        const TomlValue* value = table.find(key);
        return value != nullptr ? file_.text(*value) : otherwise;
    }

    std::vector<std::string> list(const TomlValue& table, const char* key) const {
        const TomlValue* value = table.find(key);
        if (value == nullptr) return {};
        if (value->kind == TomlValue::Kind::text) return {value->text};
        return file_.texts(*value);
    }

    /// Options allowed at the top for all cases, and in each case.
    void read_options(const TomlValue& table, SuiteCase& into) const {
        Tolerances& t = into.options.tolerances;
        if (const auto v = file_.find_number(table, "tol_lin_mm")) t.position_mm = *v;
        if (const auto v = file_.find_number(table, "tol_ang_deg"))
            t.direction_rad = rad_from_deg(*v);
        if (const auto v = file_.find_number(table, "tol_feed")) t.feed_ratio = *v;
        if (const auto v = file_.find_number(table, "tol_time")) t.time_ratio = *v;
        if (t.position_mm <= 0.0 || t.direction_rad <= 0.0)
            file_.fail(table, "tolerances are above 0");
        if (const TomlValue* by = table.find("by")) {
            const auto found = std::find(layer_names.begin(), layer_names.end(), file_.text(*by));
            if (found == layer_names.end()) file_.fail(*by, "no such layer");
            into.options.by = static_cast<Layer>(found - layer_names.begin());
        }
        if (const TomlValue* b = table.find("setup_b")) into.setup_b = path_of(file_.text(*b));
        into.options.call = text_or(table, "call", into.options.call);
        if (const TomlValue* devices = table.find("devices")) {
            if (devices->kind != TomlValue::Kind::boolean) file_.fail(*devices, "true or false");
            into.options.devices = devices->truth;
        }
        for (const std::string& folder : list(table, "programs_folders"))
            into.options.program_folders.push_back(path_of(folder));
    }

    void read_case(const TomlValue& table) {
        SuiteCase like = like_;
        read_options(table, like);
        std::vector<std::string> setups = list(table, "setups");
        if (setups.empty()) setups = list(file_.root(), "setups");
        const std::vector<std::string> programs = list(table, "program");
        if (programs.empty()) file_.fail(table, "a case needs program = \"...\"");
        std::size_t found = 0;
        for (const std::string& pattern : programs)
            for (const std::string& program : expand(pattern)) {
                ++found;
                if (setups.empty()) add(table, like, program, "", false);
                for (const std::string& setup : setups)
                    add(table, like, program, path_of(setup), setups.size() > 1);
            }
        if (found == 0) file_.fail(table, "no program matches");
    }

    void add(const TomlValue& table, SuiteCase c, const std::string& program,
             const std::string& setup, bool name_setup) {
        if (!setup.empty()) c.setup = setup;
        if (c.setup_b.empty()) c.setup_b = c.setup;
        c.b = path_of(program);
        c.name = text_or(table, "name", fs::path(program).replace_extension().generic_string());
        if (name_setup) c.name += "@" + fs::path(setup).stem().string();
        const std::string against = text_or(table, "against", ""),
                          own = text_or(table, "goldens", ""),
                          of_all = text_or(file_.root(), "goldens", "goldens");
        if (against.empty()) {
            if (!stays_inside(c.name))
                file_.fail(table, "the golden '" + c.name + "' would lie outside its folder");
            c.golden = path_of(own.empty() ? of_all : own) + "/" + c.name + ".csv";
        } else {
            if (!own.empty()) file_.fail(table, "a case has either against or goldens, not both");
            c.a = path_of(against);
            if (fs::is_directory(c.a)) c.a += "/" + fs::path(program).filename().string();
        }
        refuse_double(table, c);
        suite_.cases.push_back(std::move(c));
    }

    /// At the name of the second case, or at the case whose programs give it.
    void refuse_double(const TomlValue& table, const SuiteCase& c) {
        if (names_.insert(c.name).second) return;
        const TomlValue* name = table.find("name");
        file_.fail(name != nullptr ? *name : table, "two cases have the name '" + c.name + "'");
    }

    std::vector<std::string> expand(const std::string& pattern) const {
        if (pattern.find_first_of("*?") == std::string::npos) return {pattern};
        const fs::path parent = fs::path(pattern).parent_path();
        const std::string last = fs::path(pattern).filename().string();
        const std::string named = path_of(parent.generic_string());
        const std::string folder =
            named.empty() ? "." : named;  // the suite's, where it has no name
        std::vector<std::string> names;
        if (fs::is_directory(folder))
            for (const auto& entry : fs::directory_iterator(folder))
                if (is_regular(entry) && matches(last, entry.path().filename().string()))
                    names.push_back((parent / entry.path().filename()).generic_string());
        std::sort(names.begin(), names.end());
        return names;
    }

    void read_expected(const TomlValue& table) {
        ExpectedDifference e{text_or(table, "case", ""), text_or(table, "fingerprint", ""),
                             text_or(table, "reason", "")};
        if (e.fingerprint.empty())
            file_.fail(table, "an expected difference needs its fingerprint");
        if (e.reason.empty()) file_.fail(table, "an expected difference needs a reason");
        suite_.expected.push_back(std::move(e));
    }

    const TomlFile& file_;
    fs::path folder_;
    SuiteCase like_;
    std::set<std::string> names_;
    Suite suite_;
};

}  // namespace

std::set<std::string> programs_below(const std::string& folder) {
    if (!fs::is_directory(folder))
        throw InputError(fs::exists(folder) ? "is a file, not a folder" : "no such folder",
                         {folder, 0, 0});
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (is_regular(entry) && is_program(entry.path()))
            names.insert(entry.path().lexically_relative(folder).generic_string());
    return names;
}

Suite suite_of_folders(const std::string& a, const std::string& b, const SuiteCase& like) {
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)})
        if (fs::exists(one) && !fs::is_directory(one) && fs::is_directory(other))
            throw InputError(
                "is a file, but " + other + " is a folder: compare takes two of a kind",
                {one, 0, 0});
    Suite suite;
    suite.name = a + " " + b;
    const std::set<std::string> in_a = programs_below(a), in_b = programs_below(b);
    std::set<std::string> names = in_a;
    names.insert(in_b.begin(), in_b.end());
    if (names.empty()) throw InputError("no NC programs in either folder", {a, 0, 0});
    for (const std::string& name : names) {
        SuiteCase c = like;
        c.name = name;
        if (in_a.contains(name)) c.a = (fs::path(a) / name).generic_string();
        if (in_b.contains(name)) c.b = (fs::path(b) / name).generic_string();
        suite.cases.push_back(std::move(c));
    }
    return suite;
}

Suite read_suite(const std::string& path, const SuiteCase& like) {
    const TomlFile file(read_file(path), path);
    Suite suite = SuiteReader(file, like).read();
    file.refuse_unknown_keys();
    return suite;
}

}  // namespace trunnion::regression
