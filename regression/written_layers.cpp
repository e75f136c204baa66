#include "regression/written_layers.h"

#include <algorithm>

namespace trunnion::regression {

namespace {

const std::vector<OpenedProgram> none;

const std::vector<OpenedProgram>& opened_by(const WrittenSide& side) {
    return side.opened != nullptr ? *side.opened : none;
}

struct OneProgram {
    const interpreter::ProgramText& program;
    const setup::Setup& setup;

    std::unique_ptr<LineKeys> keys(Layer layer) const {
        return written_keys(program, layer, setup);
    }
};

bool same_program(Layer layer, OneProgram a, OneProgram b, std::uint64_t& compared) {
    std::uint64_t lines = 0;
    const bool same = same_keys(*a.keys(layer), *b.keys(layer), lines);
    compared += lines;
    return same;
}

void describe_pair(Layer layer, OneProgram a, OneProgram b, std::size_t most, Comparison& result) {
    SourceLines lines_a(a.program), lines_b(b.program);
    const std::uint64_t before = result.compared;
    describe_gaps({all_keys(*a.keys(layer)), lines_a}, {all_keys(*b.keys(layer)), lines_b}, most,
                  result);
    result.compared += before;
}

/// A program that only one side calls or finds.
void describe_missing(const OpenedProgram& program, bool only_a, Comparison& result) {
    Difference d;
    d.kind = only_a ? DifferenceKind::only_a : DifferenceKind::only_b;
    d.what = program.asked + " is called, and found, only in " + (only_a ? "A" : "B");
    d.a.program = result.a;
    d.b.program = result.b;
    (only_a ? d.a : d.b).program = program.found->name;
    result.differences.push_back(std::move(d));
}

const OpenedProgram* find(const std::vector<OpenedProgram>& programs, const std::string& asked) {
    const auto found = std::find_if(programs.begin(), programs.end(),
                                    [&](const OpenedProgram& p) { return p.asked == asked; });
    return found == programs.end() || !found->found ? nullptr : &*found;
}

}  // namespace

std::unique_ptr<LineKeys> written_keys(const interpreter::ProgramText& program, Layer layer,
                                       const setup::Setup& setup) {
    if (layer == Layer::text) return text_keys(program.text);
    return word_keys(program.text, setup.dialect, codes_call(setup));
}

bool written_alike(Layer layer, const WrittenSide& a, const WrittenSide& b,
                   std::uint64_t& compared) {
    compared = 0;
    if (!same_program(layer, {*a.main, *a.setup}, {*b.main, *b.setup}, compared)) return false;
    const auto &in_a = opened_by(a), &in_b = opened_by(b);
    return std::equal(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(),
                      [&](const OpenedProgram& p, const OpenedProgram& q) {
                          if (p.asked != q.asked || !p.found != !q.found) return false;
                          return !p.found || same_program(layer, {*p.found, *a.setup},
                                                          {*q.found, *b.setup}, compared);
                      });
}

void describe_written(Layer layer, const WrittenSide& a, const WrittenSide& b, std::size_t most,
                      Comparison& result) {
    describe_pair(layer, {*a.main, *a.setup}, {*b.main, *b.setup}, most, result);
    for (const OpenedProgram& p : opened_by(a)) {
        if (!p.found || p.found->text.data() == a.main->text.data()) continue;
        if (const OpenedProgram* q = find(opened_by(b), p.asked))
            describe_pair(layer, {*p.found, *a.setup}, {*q->found, *b.setup}, most, result);
        else
            describe_missing(p, true, result);
    }
    for (const OpenedProgram& q : opened_by(b))
        if (q.found && find(opened_by(a), q.asked) == nullptr) describe_missing(q, false, result);
}

}  // namespace trunnion::regression
