// The printed output of a measuring program: all moves and touches, and the active stores.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "base/units.h"
#include "imports/printed_lines.h"
#include "imports/row_writer.h"
#include "imports/touch_start.h"
#include "records/stops.h"
#include "records/told_lines.h"
#include "setup/programmed_point.h"

namespace trunnion::imports {
namespace {

/// A larger distance from the path means another line, not rounding of a printed number.
constexpr double most_beside_mm = 0.05;
/// A stylus ball farther from every sphere touches another object.
constexpr double most_off_sphere_mm = 20.0;
constexpr double store_digits_mm = 1e-6;  ///< more than the rounding of a printed store

struct PrintedRow {
    records::Reading row;
    int line = 0;
    int run = 1;  ///< number of the program run within the file
};

/// The axes in the order in which a control numbers them.
std::vector<Axis> numbered_axes(const setup::Setup& setup) {
    std::vector<Axis> axes;
    for (const Axis axis : all_axes)
        if (setup.machine.chain.find(axis)) axes.push_back(axis);
    return axes;
}

/// One file while its lines are being read.
class PrintedRun {
  public:
    PrintedRun(const setup::Setup& setup, const ImportFile& file, std::vector<std::string>& notes)
        : setup_(setup),
          file_(file),
          notes_(notes),
          axes_(numbered_axes(setup)),
          declared_(setup::rotary_stores(setup.machine.chain, setup.stores)),
          in_force_(declared_),
          meant_(setup, declared_) {
        for (const setup::Artefact& a : setup.artefacts)
            if (a.kind == setup::Artefact::Kind::sphere) spheres_.push_back(a);
        if (spheres_.empty() || !setup.probe)
            throw InputError("printed touches require [probe] and a sphere in the setup",
                             {setup.path});
        if (axes_.size() != 5)
            throw InputError(
                "the printed positions are of five axes that this machine does not have",
                {setup.path});
        begin_modes();
    }

    void read();
    const std::vector<PrintedRow>& rows() const { return rows_; }
    /// "603 touches in 8 tests", with the number of runs if there are several.
    std::string words() const;
    int runs() const { return runs_; }

  private:
    void take(const PrintedLine& line);
    void head(const PrintedLine& line);
    void end(const PrintedLine& line);
    void store(const PrintedLine& line);
    void take_store(const setup::StoreNumber& declared, double printed_mm);
    void take_length(const PrintedLine& line);
    void test(const PrintedLine& line);
    void positions(const PrintedLine& line);
    void at(const PrintedLine& line);
    void touch(const PrintedLine& line);
    void say(const PrintedLine& line);
    void bar(const PrintedLine& line) {
        line.fail(
            "a ballbar's lengths do not come through the control: import its recordings (import "
            "ballbar)");
    }
    void result(const PrintedLine& line) {
        if (line.text.ends_with(" END")) end(line);
    }
    void begin_modes() { mode_ = plain_mode_ = PositioningMode::dpp; }
    std::string sphere_at(const PrintedLine& line, const AxisPositions& skip) const;
    void append(records::Reading row, int line);

    struct Word {
        const char* word;
        void (PrintedRun::*take)(const PrintedLine&);
    };
    static const Word words_[];

    const setup::Setup& setup_;
    const ImportFile& file_;
    std::vector<std::string>& notes_;
    std::vector<Axis> axes_;
    std::vector<setup::Artefact> spheres_;
    std::vector<PrintedRow> rows_;
    records::Stops stops_;
    records::ShopState shop_;
    PositioningMode mode_ = PositioningMode::none, plain_mode_ = PositioningMode::none;
    std::string test_;
    std::optional<AxisPositions> stands_;
    std::optional<TouchStart> begun_;  ///< of the last touch
    std::optional<setup::RotaryStores> declared_, in_force_;
    std::optional<double> length_mm_;  ///< of the probe, if it is not the declared one
    setup::ProgrammedPoint meant_;
    double unit_mm_ = 1.0, time_s_ = 0.0;
    std::size_t touches_ = 0, tests_ = 0;
    int runs_ = 0;
    std::optional<PrintedLine> running_;  ///< head of the program that has not yet ended
    bool timed_ = false;
};

const PrintedRun::Word PrintedRun::words_[] = {
    {"PIVOT", &PrintedRun::head},
    {"MEASUREMENT", &PrintedRun::head},
    {"STORE", &PrintedRun::store},
    {"TEST", &PrintedRun::test},
    {"AT", &PrintedRun::at},
    {"TOUCH", &PrintedRun::touch},
    {"POSITIONS", &PrintedRun::positions},
    {"MODE", &PrintedRun::say},
    {"SPINDLE", &PrintedRun::say},
    {"LOAD", &PrintedRun::say},
    {"TEMPERATURE", &PrintedRun::say},
    {"CLAMPED", &PrintedRun::say},
    {"EXTENSION", &PrintedRun::say},
    {"DPP", &PrintedRun::result},
    {"RTDFO", &PrintedRun::result},
    {"RTCP", &PrintedRun::result},
    {"TW", &PrintedRun::result},
    {"BALLBAR", &PrintedRun::bar},
    {"SAMPLE", &PrintedRun::bar},
};

void PrintedRun::read() {
    std::string_view text = file_.text;
    int number = 0;
    std::optional<PrintedLine> last;
    while (auto line = next_line(text, number, file_.path)) {
        take(*line);
        last = line;
    }
    if (!last) throw InputError("nothing was printed", {file_.path, 1, 1});
    if (running_) last->fail("the program stopped here: the last line of its output is missing");
    if (touches_ == 0) last->fail("no touch was printed");
}

void PrintedRun::take(const PrintedLine& line) {
    for (const Word& word : words_)
        if (line.word() == word.word) return (this->*word.take)(line);
    line.fail("no line of a measuring program");
}

void PrintedRun::head(const PrintedLine& line) {
    if (line.text.ends_with(" END")) return end(line);
    if (running_)
        running_->fail(fmt::format(
            "this program stopped: another one begins in line {} before its END", line.number));
    running_ = line;
    ++runs_;
    const std::size_t at = line.text.find(" AXES ");
    if (at == std::string_view::npos) line.fail("the head of a program names its AXES");
    std::string rotary, named;
    for (const Axis axis : axes_)
        if (is_rotary(axis)) rotary += letter_of(axis);
    for (const char c : line.text.substr(at + 5, 4))
        if (c != ' ') named += c;
    std::sort(named.begin(), named.end());
    if (named != rotary)
        line.fail("prints of another machine: the setup has the rotary axes " + rotary, at + 6);
    stops_.clear();
    stands_.reset();
    begun_.reset();
    timed_ = false;
    shop_ = {};
    begin_modes();
    in_force_ = declared_;
    length_mm_.reset();
    meant_ = setup::ProgrammedPoint(setup_, declared_);
}

void PrintedRun::end(const PrintedLine& line) {
    if (!running_) line.fail("END of a program whose head was not printed");
    running_.reset();
}

/// A printed store within its rounding is the declared one.
void PrintedRun::take_store(const setup::StoreNumber& declared, double printed_mm) {
    const bool same = std::abs(printed_mm - declared.value_mm) <= store_digits_mm;
    setup::set_number(*in_force_, declared, same ? declared.value_mm : printed_mm);
    if (!same)
        notes_.push_back(
            fmt::format("{}: {} was {:.4f} when the program ran, the setup declares {:.4f}",
                        file_.path, declared.name, printed_mm, declared.value_mm));
}

/// The program prints the offset that it uses for the probe.
void PrintedRun::take_length(const PrintedLine& line) {
    const double declared_mm = setup::probe_length_mm(setup_), printed_mm = line.number_behind('V');
    if (std::abs(printed_mm - declared_mm) <= store_digits_mm) return;
    length_mm_ = printed_mm;
    notes_.push_back(
        fmt::format("{}: H{:g} was {:.4f} when the program ran, the setup declares {:.4f}",
                    file_.path, line.number_behind('H'), printed_mm, declared_mm));
}

void PrintedRun::store(const PrintedLine& line) {
    const std::string_view rest = line.text.substr(std::min<std::size_t>(6, line.text.size()));
    if (rest.starts_with("INCH")) {
        unit_mm_ = rest.ends_with('1') ? mm_from_inch(1.0) : 1.0;
        return;
    }
    if (!declared_) return;
    if (rest.starts_with("H")) take_length(line);
    for (const setup::StoreNumber& n : setup::store_numbers(*declared_)) {
        if (n.parameter == 0 && rest.starts_with("G54 "))
            take_store(n, line.number_behind("XYZ"[n.component]));
        if (n.parameter != 0 && rest.starts_with(fmt::format("N{} ", n.parameter)))
            take_store(n, unit_mm_ * line.number_behind('V'));
    }
    meant_ = setup::ProgrammedPoint(setup_, in_force_, length_mm_);
}

void PrintedRun::test(const PrintedLine& line) {
    test_ = records::told_name(records::told_words(line.text, "TEST").value_or(""));
    if (test_.empty()) line.fail("TEST wants a name");
    ++tests_;
}

void PrintedRun::positions(const PrintedLine& line) {
    plain_mode_ = line.text.ends_with(" DIRECT") ? PositioningMode::none : PositioningMode::dpp;
    mode_ = plain_mode_;
}

void PrintedRun::say(const PrintedLine& line) {
    records::take_told(line.text, shop_);
    if (const auto mode = records::told_mode(line.text)) mode_ = *mode;
}

void PrintedRun::at(const PrintedLine& line) {
    AxisPositions q;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
        const double value = line.number_behind("XYZDE"[k]);
        q[axes_[k]] = is_rotary(axes_[k]) ? rad_from_deg(value) : value;
    }
    records::Reading stop;
    stop.commanded = q;
    stop.mode = mode_;
    stop.test = test_;
    stop.line = line.number;
    stops_.pass(stop, rows_.empty() ? nullptr : &rows_.back().row.commanded);
    stands_ = q;
}

/// The sphere nearest to the stylus ball, according to the setup.
std::string PrintedRun::sphere_at(const PrintedLine& line, const AxisPositions& skip) const {
    const auto poses = setup_.machine.poses(skip);
    const Vector3 tip_M = poses.pose_MS * setup_.probe->tip_with(shop_.extension_mm);
    const auto off_mm = [&](const setup::Artefact& sphere) {
        return std::abs((tip_M - poses.pose_MW * sphere.center_W_mm).norm() -
                        0.5 * (sphere.diameter_mm + setup_.probe->ball_diameter_mm));
    };
    const auto nearest =
        std::min_element(spheres_.begin(), spheres_.end(),
                         [&](const auto& a, const auto& b) { return off_mm(a) < off_mm(b); });
    if (off_mm(*nearest) > most_off_sphere_mm)
        line.fail(fmt::format("no sphere of {} is within {:.0f} mm of this touch", setup_.path,
                              most_off_sphere_mm));
    return nearest->name;
}

void PrintedRun::touch(const PrintedLine& line) {
    if (!stands_) line.fail("a touch before any line AT: where it began is not known");
    const Vector3 way = line.vector_behind("IJK");
    const Vector3 start = line.vector_behind("XYZ"), gone = line.vector_behind("UVW") - start;
    const double length_mm = way.norm();
    if (length_mm <= 0.0) line.fail("a touch without a way (I J K are 0)");
    const double along_mm = gone.dot(way) / length_mm;
    if ((gone - along_mm / length_mm * way).norm() > most_beside_mm ||
        along_mm > length_mm + most_beside_mm || along_mm < -most_beside_mm)
        line.fail("the skip position U V W is not on the way I J K from X Y Z");
    const TouchStart begins{test_, mode_, *stands_, start};
    if (begun_ && !advances(*begun_, begins, most_beside_mm))
        line.fail(
            "this touch does not begin where the line AT before it stands: a line is missing");
    begun_ = begins;
    records::Reading row;
    row.device = records::Device::touch;
    row.direction_M = way / length_mm;
    row.value_mm = along_mm - length_mm;
    row.mode = mode_;
    row.test = test_;
    row.feed_mm_min = line.number_behind('F');
    records::put_shop(shop_, row);
    row.commanded = *stands_;
    AxisPositions skip = *stands_;
    for (std::size_t d = 0; d < 3; ++d) {
        row.commanded[all_axes[d]] += way(static_cast<Eigen::Index>(d));
        skip[all_axes[d]] += gone(static_cast<Eigen::Index>(d));
    }
    row.feature = sphere_at(line, skip);
    row.point_W_mm = meant_.at(row.mode, row.commanded, row.extension_mm);
    const double time_s = 1e-3 * line.number_behind('T');
    if (timed_ && time_s < time_s_)
        line.fail("times are not in ascending order", line.text.rfind('T'));
    time_s_ = row.time_s = time_s;
    timed_ = true;
    append(std::move(row), line.number);
    ++touches_;
}

void PrintedRun::append(records::Reading row, int line) {
    const bool first = rows_.empty() || rows_.back().run != runs_;
    const double since_s = first ? row.time_s : rows_.back().row.time_s;
    for (records::Reading& stop : stops_.before(row.commanded)) {
        stop.feature = row.feature;
        stop.time_s = std::min(since_s, row.time_s);
        const int at = stop.line;
        rows_.push_back({std::move(stop), at, runs_});
    }
    stops_.clear();
    rows_.push_back({std::move(row), line, runs_});
}

std::string PrintedRun::words() const {
    return fmt::format("{} touches in {} tests{}", touches_, tests_,
                       runs_ > 1 ? fmt::format(", {} runs of programs", runs_) : "");
}

std::vector<std::string> columns_of(const std::vector<PrintedRow>& rows) {
    std::vector<records::Reading> plain;
    for (const PrintedRow& row : rows) plain.push_back(row.row);
    std::vector<std::string> columns{"mode", "feed_mm_min"};
    for (std::string& name : records::shop_columns(plain)) columns.push_back(std::move(name));
    return columns;
}

/// `--with session=each`: each program run of each file is a separate session.
void write_runs(const std::vector<PrintedRow>& printed, const Facts& facts, int& session,
                RowWriter& rows) {
    const bool each = facts.text("session") == "each";
    int run = 1;
    if (each) ++session;
    for (const PrintedRow& row : printed) {
        if (row.run != run) {
            rows.begin_run();
            if (each) ++session;
        }
        run = row.run;
        records::Reading reading = row.row;
        if (each) reading.session = fmt::format("run_{}", session);
        rows.add(std::move(reading), row.line);
    }
}

}  // namespace

Imported import_dprnt(const ImportRequest& request) {
    Imported result;
    std::vector<PrintedRow> all;
    std::vector<std::vector<PrintedRow>> files;
    int runs = 0;
    for (const ImportFile& file : request.files) {
        PrintedRun run(request.setup, file, result.notes);
        run.read();
        files.push_back(run.rows());
        all.insert(all.end(), run.rows().begin(), run.rows().end());
        runs += run.runs();
        result.summary.push_back(file.path + ": " + run.words());
    }
    if (runs > static_cast<int>(files.size()) && !request.facts.has("session"))
        result.notes.push_back(
            fmt::format("{} program runs are taken as one set-up; --with session=each makes each "
                        "run a session, for an artefact or a probe that was remounted between them",
                        runs));
    RowWriter rows(request.setup, "dprnt", columns_of(all), true, false);
    int session = 0;
    for (std::size_t k = 0; k < files.size(); ++k) {
        rows.begin_file(request.files[k].path, request.facts);
        write_runs(files[k], request.facts, session, rows);
    }
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports
