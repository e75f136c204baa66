#include "choices/edited_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "choices/store_columns.h"

namespace trunnion::choices {

namespace {

constexpr std::string_view number_letters = "XYZABCUVWIJKRQ";
constexpr std::size_t most_origins = 8;  ///< blocks that set an origin, a side or a length
constexpr std::size_t edits_before = 2, edits_behind = 1;
constexpr std::size_t most_tools = 6;                 ///< tried instead of one
constexpr double promising = 0.3;                     ///< of the least gain, by the derivative
constexpr int least_decimals = 2, most_decimals = 4;  ///< with which a number is entered
constexpr double a_number = 2.0;                      ///< of a loss: what a fitted number is worth
constexpr int edit_rounds = 6;
constexpr double edit_falls = 0.999;  ///< of the loss

/// A word of the program: a letter and a number.
struct Word {
    char letter = 0;
    std::size_t begin = 0, end = 0;  ///< in the text, from the letter on
    double value = 0.0;
    bool has_point = false;
    int decimals = 0;
};

struct Line {
    std::size_t begin = 0, end = 0;
};

std::vector<Line> lines_of(std::string_view text) {
    std::vector<Line> out{{0, 0}};  // lines count from 1
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        out.push_back({begin, end});
        begin = end + 1;
    }
    return out;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Words with a constant number; comments and expressions have none.
std::vector<Word> words_of(std::string_view text, const Line& line) {
    std::vector<Word> out;
    int depth = 0;
    for (std::size_t k = line.begin; k < line.end;) {
        const char c = text[k];
        if (c == '(' || c == '[') ++depth;
        if (c == ')' || c == ']') --depth;
        if (depth > 0 || std::isalpha(static_cast<unsigned char>(c)) == 0) {
            ++k;
            continue;
        }
        Word word{static_cast<char>(std::toupper(static_cast<unsigned char>(c))),
                  k,
                  k + 1,
                  0.0,
                  false,
                  0};
        std::string number;
        for (; word.end < line.end; ++word.end) {
            const char d = text[word.end];
            if (!is_digit(d) && d != '.' && !(number.empty() && (d == '-' || d == '+'))) break;
            if (word.has_point) ++word.decimals;
            word.has_point = word.has_point || d == '.';
            number += d;
        }
        k = word.end;
        if (std::none_of(number.begin(), number.end(), is_digit)) continue;
        word.value = std::strtod(number.c_str(), nullptr);
        out.push_back(word);
    }
    return out;
}

bool has_code(const std::vector<Word>& words, std::initializer_list<double> codes) {
    return std::any_of(words.begin(), words.end(), [&](const Word& word) {
        return word.letter == 'G' &&
               std::find(codes.begin(), codes.end(), word.value) != codes.end();
    });
}

class Editor {
  public:
    explicit Editor(const EditQuestion& question)
        : asked_(question),
          text_(question.comparer.program().text),
          lines_(lines_of(text_)),
          most_(question.run.loss - question.least_gain) {}

    std::vector<BlockEdit> edits() {
        const std::set<int> near = blocks_near();
        std::set<int> all = near;
        for (const int line : settings_before(near)) all.insert(line);
        for (const int line : all) {
            for (const Word& word : words_of(text_, lines_[static_cast<std::size_t>(line)])) {
                try_number(line, word);
                try_code(line, word);
            }
            if (near.contains(line)) try_without(line);
        }
        // Another code or a missing block is as good as a number that happens to do the same.
        const auto cost = [](const BlockEdit& edit) {
            return edit.run.loss + a_number * static_cast<double>(edit.numbers);
        };
        std::stable_sort(found_.begin(), found_.end(),
                         [&](const BlockEdit& a, const BlockEdit& b) { return cost(a) < cost(b); });
        return std::move(found_);
    }

  private:
    /// Lines of the main program where the gap begins, and beside them.
    std::set<int> blocks_near() const {
        const ControlPath& path = asked_.run.path;
        std::size_t row = asked_.run.losses.size(), node = 0;
        for (const Pair& pair : asked_.run.pairs)
            if (pair.row < row && asked_.is_far(pair.row)) {
                row = pair.row;
                node = pair.node;
            }
        std::set<int> out;
        const auto add = [&](std::size_t k) {
            const PathBlock& block = path.blocks[path.nodes[k].block];
            if (block.program.empty() && block.line > 0 &&
                static_cast<std::size_t>(block.line) < lines_.size())
                out.insert(block.line);
        };
        if (row == asked_.run.losses.size()) return out;
        for (std::size_t k = node + 1; k-- > 0 && out.size() <= edits_before;) add(k);
        const std::size_t most = out.size() + edits_behind;
        for (std::size_t k = node; k < path.nodes.size() && out.size() < most; ++k) add(k);
        return out;
    }
    /// Blocks before these that set an origin, a work offset, a side or a length.
    std::vector<int> settings_before(const std::set<int>& near) const {
        std::vector<int> out;
        if (near.empty()) return out;
        for (int line = *near.rbegin(); line > 0 && out.size() < most_origins; --line) {
            const auto words = words_of(text_, lines_[static_cast<std::size_t>(line)]);
            if (has_code(words,
                         {10, 51, 52, 54, 55, 56, 57, 58, 59, 68, 68.2, 92, 41, 42, 43, 43.4}))
                out.push_back(line);
        }
        return out;
    }
    std::string with(const Word& word, const std::string& instead) const {
        return std::string(text_.substr(0, word.begin)) + instead +
               std::string(text_.substr(word.end));
    }
    interpreter::ProgramText program_of(const std::string& text) const {
        return {asked_.comparer.program().name, text, nullptr};
    }
    static std::string written(const Word& word, double value) {
        std::string number = fmt::format("{:.4f}", value);
        number.erase(number.find_last_not_of('0') + 1);
        return word.letter + number;
    }
    ControlPath path_with(const Word& word, double value) const {
        const std::string text = with(word, written(word, value));
        const auto program = program_of(text);
        return asked_.comparer.of(program).path(asked_.setup);
    }
    ComparedRun run_of(const std::string& text) const {
        const auto program = program_of(text);
        return asked_.comparer.of(program).run(asked_.setup);
    }
    /// Nobody types more decimals than the program has: a number that needs them is no edit.
    static double entered(const Word& word, double value) {
        const double unit =
            std::pow(10.0, std::clamp(word.decimals, least_decimals, most_decimals));
        return std::round(unit * value) / unit;
    }
    void take(int line, const std::string& said, std::size_t numbers, ComparedRun run) {
        if (run.loss > most_) return;
        found_.push_back({line, fmt::format("line {} {}", line, said), numbers, std::move(run)});
    }

    /// Change of the number by the derivative, and the loss that it should remove.
    std::pair<double, double> step_of(const Word& word, double value,
                                      const ComparedRun& now) const {
        const auto column = column_of(asked_.comparer, now,
                                      [&](double step) { return path_with(word, value + step); });
        if (!column) return {0.0, 0.0};
        const Normal normal = normal_of(asked_.comparer, now, {*column});
        const double matrix = normal.matrix(0, 0), right = normal.right[0];
        return matrix > 0.0 ? std::pair(right / matrix, right * right / matrix)
                            : std::pair(0.0, 0.0);
    }
    void try_number(int line, const Word& word) {
        if (!word.has_point || number_letters.find(word.letter) == std::string_view::npos) return;
        double value = word.value;
        auto [change, gain] = step_of(word, value, asked_.run);
        if (gain < promising * asked_.least_gain) return;
        ComparedRun best;
        for (int round = 0; round < edit_rounds; ++round) {
            const double next = entered(word, value + change);
            if (next == value) break;
            ComparedRun run = run_of(with(word, written(word, next)));
            const double before = round == 0 ? asked_.run.loss : best.loss;
            if (run.loss >= edit_falls * before) break;
            value = next;
            best = std::move(run);
            change = step_of(word, value, best).first;
        }
        if (value != word.value) take(line, "reads " + written(word, value), 1, std::move(best));
    }
    /// Other offsets of tools that are not empty.
    std::vector<int> other_tools(int number, bool length) const {
        std::vector<int> out;
        const auto& tools = asked_.setup.stores.tools.tool;
        for (std::size_t n = 1; n < tools.size() && out.size() < most_tools; ++n)
            if (static_cast<int>(n) != number &&
                (length ? tools[n].length_mm() : tools[n].radius_mm()) != 0.0)
                out.push_back(static_cast<int>(n));
        return out;
    }
    /// Another work offset, the other side, another tool offset.
    void try_code(int line, const Word& word) {
        constexpr double beyond_codes = 1000.0;  // no code or offset has four digits
        if (std::abs(word.value) >= beyond_codes) return;
        const int code = static_cast<int>(word.value);
        if (word.value != code) return;
        std::vector<int> others;
        if (word.letter == 'D' || word.letter == 'H')
            others = other_tools(code, word.letter == 'H');
        if (word.letter == 'G' && (code == 41 || code == 42)) others = {83 - code};
        if (word.letter == 'G' && code >= 54 && code <= 59)
            for (int other = 54; other <= 59; ++other)
                if (other != code) others.push_back(other);
        for (const int other : others) {
            const std::string said = fmt::format("{}{}", word.letter, other);
            take(line, "reads " + said, 0, run_of(with(word, said)));
        }
    }
    void try_without(int line) {
        const Line& at = lines_[static_cast<std::size_t>(line)];
        if (at.begin < at.end && text_[at.begin] == '/') return;  // a switch leaves it out
        const std::string text =
            std::string(text_.substr(0, at.begin)) + std::string(text_.substr(at.end));
        take(line, "is left out", 0, run_of(text));
    }

    const EditQuestion& asked_;
    std::string_view text_;
    std::vector<Line> lines_;
    double most_;  ///< loss that an edit may leave
    std::vector<BlockEdit> found_;
};

}  // namespace

std::vector<BlockEdit> edits_of(const EditQuestion& question) {
    return Editor(question).edits();
}

}  // namespace trunnion::choices
