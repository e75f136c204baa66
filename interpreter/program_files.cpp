#include "interpreter/program_files.h"

#include <algorithm>

#include "interpreter/keywords.h"
#include "interpreter/lexical.h"
#include "interpreter/line_scan.h"

namespace trunnion::interpreter {
namespace {

constexpr int outside = -2;                    ///< instead of a file id: from the source only
constexpr std::size_t largest_index = 300000;  ///< maximum number of N numbers indexed for one
                                               ///< program: 4.8 MB

bool by_number(const Numbered& a, const Numbered& b) {
    return a.number != b.number ? a.number < b.number : a.byte < b.byte;
}

bool begins_other(const LineHead& head, const Section& section) {
    return head.kind == LineKind::over ||
           (head.kind == LineKind::program && head.place.byte > section.begin.byte);
}

/// The loop statement at the beginning of a line: DO n > 0, END n < 0, neither 0.
int loop_step(const LineHead& head, const char* end) {
    const char* p = head.content;
    if (p == end || !is_letter(*p)) return 0;
    const Keyword keyword = read_keyword(p, end);
    if (keyword == Keyword::while_) {
        const char* const stop = find_line_end(p, end);
        while (p != stop && !(upper(*p) == 'D' && p + 1 != stop && upper(p[1]) == 'O')) ++p;
        if (p == stop) return 0;
        p += 2;
    } else if (keyword != Keyword::do_ && keyword != Keyword::end) {
        return 0;
    }
    p = skip_blanks(p, end);
    const int number = p != end && *p >= '1' && *p <= '3' ? *p - '0' : 0;
    return keyword == Keyword::end ? -number : number;
}

/// True when the last word of a line, before comments, is THEN.
bool ends_with_then(const char* p, const char* end) {
    char last[4] = {};
    bool comment = false;
    for (const char* const stop = find_line_end(p, end); p != stop && *p != ';'; ++p) {
        if (*p == '(' || *p == ')') comment = *p == '(';
        if (comment || *p == ')' || *p == ' ' || *p == '\t') continue;
        std::copy(last + 1, last + 4, last);
        last[3] = upper(*p);
    }
    return std::string_view(last, 4) == "THEN";
}

/// The branch statement at the beginning of a line: IF .. THEN alone 1, ELSE 0, ENDIF -1.
std::optional<int> branch_step(const LineHead& head, const char* end) {
    const char* p = head.content;
    if (p == end || !is_letter(*p)) return std::nullopt;
    const Keyword keyword = read_keyword(p, end);
    if (keyword == Keyword::else_) return 0;
    if (keyword == Keyword::if_ && ends_with_then(p, end)) return 1;
    p = skip_blanks(p, end);
    if (keyword == Keyword::end && p != end && upper(*p) == 'I') return -1;
    return std::nullopt;
}

}  // namespace

ProgramFile& ProgramFiles::add(const ProgramText& text) {
    for (auto& file : files_)
        if (file->text.text.data() == text.text.data() &&
            file->text.text.size() == text.text.size())
            return *file;
    auto file = std::make_unique<ProgramFile>();
    file->id = static_cast<int>(files_.size());
    file->text = text;
    files_.push_back(std::move(file));
    return *files_.back();
}

Section& ProgramFiles::section_at(ProgramFile& file, TextPlace place, int o_number) {
    for (auto& section : sections_)
        if (section->file == &file && section->begin.byte == place.byte) return *section;
    auto section = std::make_unique<Section>();
    section->file = &file;
    section->begin = place;
    section->o_number = o_number;
    section->read_to = place.byte;
    sections_.push_back(std::move(section));
    return *sections_.back();
}

/// Blank lines, `%` lines, folder lines and comments before the first program are skipped.
Section& ProgramFiles::open(const ProgramText& text) {
    ProgramFile& file = add(text);
    std::optional<LineHead> first;
    for (LineScan scan(text.text, start_of_text(text.text)); scan.next();) {
        const LineHead& head = scan.head();
        if (head.kind == LineKind::blank ||
            (head.kind == LineKind::over && *head.content != control_z))
            continue;
        first = head;
        break;
    }
    if (!first) return section_at(file, {text.text.size(), 1}, 0);
    return section_at(file, first->place, first->kind == LineKind::program ? first->number : 0);
}

Section* ProgramFiles::find_in(ProgramFile& file, int number) {
    if (!file.listed) {
        file.listed = true;
        for (LineScan scan(file.text.text, start_of_text(file.text.text)); scan.next();)
            if (scan.head().kind == LineKind::program && scan.head().number > 0)
                file.programs.push_back(
                    {scan.head().number, scan.head().place.line, scan.head().place.byte});
        std::stable_sort(file.programs.begin(), file.programs.end(), by_number);
    }
    const auto it = std::lower_bound(file.programs.begin(), file.programs.end(),
                                     Numbered{number, 0, 0}, by_number);
    if (it == file.programs.end() || it->number != number) return nullptr;
    return &section_at(file, {it->byte, it->line}, number);
}

Section* ProgramFiles::find(int number, const Section* near) {
    const auto key = std::make_pair(near ? near->file->id : -1, number);
    const auto known = found_.find(key);
    if (known != found_.end()) return known->second;
    Section* section = near ? find_in(*near->file, number) : nullptr;
    if (!section && !files_.empty()) section = find_in(*files_.front(), number);
    if (!section) section = find_outside(number);
    return found_[key] = section;
}

Section* ProgramFiles::find_in(ProgramFile& file, std::string_view name) {
    const std::string_view text = file.text.text;
    const std::string wanted = "<" + std::string(name) + ">";
    for (LineScan scan(text, start_of_text(text)); scan.next();) {
        const LineHead& head = scan.head();
        if (head.kind != LineKind::program || *head.content != '<') continue;
        const auto at = static_cast<std::size_t>(head.content - text.data());
        if (text.compare(at, wanted.size(), wanted) == 0) return &section_at(file, head.place, 0);
    }
    return nullptr;
}

Section* ProgramFiles::find(std::string_view name, const Section& near) {
    const auto known = named_.find(name);
    if (known != named_.end()) return known->second;
    Section* section = find_in(*near.file, name);
    if (!section) {
        const std::optional<ProgramText> text = source_.find(name);
        if (text) section = find_in(add(*text), name);
        if (text && !section) section = &open(*text);
    }
    named_.emplace(name, section);
    return section;
}

Section* ProgramFiles::find_outside(int number) {
    const auto key = std::make_pair(outside, number);
    const auto known = found_.find(key);
    if (known != found_.end()) return known->second;
    Section*& section = found_[key];
    const std::optional<ProgramText> text = source_.find(number);
    if (!text) return section = nullptr;
    section = find_in(add(*text), number);
    if (section) return section;
    section = &open(*text);
    if (section->o_number == 0) section->o_number = number;
    return section;
}

void ProgramFiles::build_index(Section& section) {
    for (auto& other : sections_) {  // only one large index at a time, to bound memory
        if (other->index.size() < largest_index / 10) continue;
        other->index = {};
        other->indexed = false;
    }
    section.indexed = true;
    for (LineScan scan(section.file->text.text, section.begin); scan.next();) {
        const LineHead& head = scan.head();
        ++lines_searched_;
        if (begins_other(head, section)) break;
        if (head.sequence_number < 0) continue;
        if (section.index.size() == largest_index) {
            section.index = {};
            section.index_too_large = true;
            return;
        }
        section.index.push_back({head.sequence_number, head.place.line, head.place.byte});
    }
    std::sort(section.index.begin(), section.index.end(), by_number);
}

std::optional<TextPlace> ProgramFiles::search_text(const Section& section, int number,
                                                   std::uint64_t after) {
    std::optional<TextPlace> before;
    for (LineScan scan(section.file->text.text, section.begin); scan.next();) {
        const LineHead& head = scan.head();
        ++lines_searched_;
        if (begins_other(head, section)) break;
        if (head.sequence_number != number) continue;
        if (head.place.byte > after) return head.place;
        if (!before) before = head.place;
    }
    return before;
}

std::optional<TextPlace> ProgramFiles::find_sequence(Section& section, int number,
                                                     std::uint64_t after) {
    if (!section.indexed && !section.index_too_large) build_index(section);
    if (section.index_too_large) return search_text(section, number, after);
    const auto& index = section.index;
    const auto from = [&](std::uint64_t byte) {
        return std::lower_bound(index.begin(), index.end(), Numbered{number, 0, byte}, by_number);
    };
    auto it = from(after + 1);
    if (it == index.end() || it->number != number) it = from(0);
    if (it == index.end() || it->number != number) return std::nullopt;
    return TextPlace{it->byte, it->line};
}

std::optional<TextPlace> ProgramFiles::find_loop_end(const Section& section, TextPlace from,
                                                     int number) {
    const std::string_view text = section.file->text.text;
    std::vector<int> open{number};
    for (LineScan scan(text, from); scan.next();) {
        ++lines_searched_;
        if (begins_other(scan.head(), section)) return std::nullopt;
        const int step = loop_step(scan.head(), text.data() + text.size());
        if (step > 0 && std::find(open.begin(), open.end(), step) != open.end())
            return std::nullopt;
        if (step > 0) open.push_back(step);
        if (step >= 0) continue;
        if (open.back() != -step) return std::nullopt;
        open.pop_back();
        if (open.empty()) return scan.behind();
    }
    return std::nullopt;
}

std::optional<TextPlace> ProgramFiles::find_branch_end(const Section& section, TextPlace from,
                                                       bool to_else) {
    const std::string_view text = section.file->text.text;
    int depth = 0;
    for (LineScan scan(text, from); scan.next();) {
        ++lines_searched_;
        if (begins_other(scan.head(), section)) return std::nullopt;
        const auto step = branch_step(scan.head(), text.data() + text.size());
        if (!step) continue;
        const bool here = *step < 0 || (*step == 0 && to_else);
        if (depth == 0 && here) return scan.behind();
        depth += *step;
    }
    return std::nullopt;
}

void ProgramFiles::forget_first_blocks() {
    for (auto& section : sections_) section->first_block = -1;
}

}  // namespace trunnion::interpreter
