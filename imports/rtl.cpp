#include "imports/rtl.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "base/alarm.h"
#include "base/numbers.h"

namespace trunnion::imports {

namespace {

constexpr std::string_view first_part = "HEADER::", targets_part = "TARGET DATA::",
                           text_part = "USER-TEXT::", data_part = "DEVIATIONS::";

std::vector<std::string> parts_in(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

bool all_numbers(const std::vector<std::string>& words) {
    for (const std::string& word : words)
        if (!parse_number(word)) return false;
    return !words.empty();
}

/// A reading: run and target count from 1.
struct Deviation {
    std::size_t line = 0, run = 0, target = 0;
    std::string text;
};

class RtlFile {
  public:
    explicit RtlFile(const ImportFile& file) : file_(file) {
        std::istringstream in(file.text);
        for (std::string line; std::getline(in, line);) take(line);
        if (header_ == 0 || targets_.empty())
            fail(1, header_ == 0 ? "no deviations: the part 'Run Target Data:' is missing"
                                 : "no targets");
        if (count_ != 0 && count_ != targets_.size())
            fail(1, fmt::format("{} targets, but Target-count is {}", targets_.size(), count_));
    }

    std::string table(const std::string& unit, std::vector<std::string>& notes) {
        lines_[header_ - 1] = "target;run;direction;deviation [" + unit + "]";
        const auto rising = directions();
        std::map<std::size_t, int> number;  // a run's number among those of its direction
        int ways[2] = {0, 0};
        for (const Deviation& d : deviations_) {
            if (one_way_ && d.run % 2 == 0) continue;
            const bool up = rising.at(d.run);
            if (number[d.run] == 0) number[d.run] = ++ways[up ? 1 : 0];
            lines_[d.line - 1] = fmt::format("{};{};{};{}", targets_[d.target - 1], number[d.run],
                                             up ? '+' : '-', d.text);
        }
        if (one_way_) notes.push_back(file_.path + ": one direction: even runs are left out");
        std::string out;
        for (const std::string& line : lines_) out += line + '\n';
        return out;
    }

  private:
    [[noreturn]] void fail(std::size_t line, const std::string& message) const {
        throw InputError(message, {file_.path, static_cast<int>(line), 1});
    }

    void take(std::string line) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        lines_.push_back(part_ == text_part ? line : "");
        const std::vector<std::string> words = parts_in(line);
        if (words.empty()) return;
        if (line.ends_with("::")) {
            part_ = line;
            lines_.back().clear();
        } else if (part_ == targets_part) {
            take_target(line, words);
        } else if (part_ == data_part) {
            take_deviation(line, words);
        }
    }

    void take_target(const std::string& line, const std::vector<std::string>& words) {
        if (line.starts_with("Target-count:"))
            count_ = static_cast<std::size_t>(parse_number(words.back()).value_or(0.0));
        if (line.starts_with("Flags:")) one_way_ = words.size() > 2 && words[2] == "1";
        if (all_numbers(words)) targets_.insert(targets_.end(), words.begin(), words.end());
    }

    void take_deviation(const std::string& line, const std::vector<std::string>& words) {
        if (line.starts_with("Run")) {
            header_ = lines_.size();
            return;
        }
        if (words.size() != 3 || !all_numbers(words))
            fail(lines_.size(), "run, target and deviation expected: '1 1 0.5'");
        const double run = *parse_number(words[0]), target = *parse_number(words[1]);
        if (!(run >= 1.0 && run < 1e6)) fail(lines_.size(), "runs count from 1");
        if (!(target >= 1.0 && target <= static_cast<double>(targets_.size())))
            fail(lines_.size(), fmt::format("target {} of {}", words[1], targets_.size()));
        deviations_.push_back({lines_.size(), static_cast<std::size_t>(run),
                               static_cast<std::size_t>(target), words[2]});
    }

    /// By the order of a run's targets; a run of one target: the odd ones rise.
    std::map<std::size_t, bool> directions() const {
        std::map<std::size_t, std::pair<double, double>> ends;
        for (const Deviation& d : deviations_) {
            const double at = *parse_number(targets_[d.target - 1]);
            ends.try_emplace(d.run, at, at).first->second.second = at;
        }
        std::map<std::size_t, bool> rising;
        for (const auto& [run, way] : ends)
            rising[run] = way.first == way.second ? run % 2 == 1 : way.first < way.second;
        return rising;
    }

    const ImportFile& file_;
    std::vector<std::string> lines_, targets_;
    std::vector<Deviation> deviations_;
    std::string part_;
    std::size_t count_ = 0, header_ = 0;
    bool one_way_ = false;
};

}  // namespace

bool is_rtl(std::string_view text) {
    return text.starts_with(first_part) && text.find(data_part) != text.npos;
}

std::string table_of_rtl(const ImportFile& file, const Facts& facts,
                         std::vector<std::string>& notes) {
    notes.push_back(file.path +
                    ": read as .rtl, known from a program that writes it, not from its maker");
    return RtlFile(file).table(facts.text("unit", "um"), notes);
}

}  // namespace trunnion::imports
