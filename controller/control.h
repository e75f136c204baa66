// The parts of a running control. Only block execution, the table of actions and the system
// variables see all of them; every subject gets the parts that it needs.
#pragma once

#include "controller/arc_3d.h"
#include "controller/cycles.h"
#include "controller/data_setting.h"
#include "controller/m_codes.h"
#include "controller/modal_variables.h"
#include "controller/reference_points.h"
#include "controller/signal_variables.h"
#include "controller/skip.h"
#include "controller/tilted_plane_codes.h"
#include "controller/wrapped_motion.h"

namespace trunnion::controller {

struct Control {
    Control(ControlConfig config_, offsets::Stores& stores_, motion::MotionSink& sink);

    ControlConfig config;
    offsets::Stores& stores;
    SortedWords words;  ///< of the block being executed
    Modal modal;
    Frames frames;
    Mover mover;

    CycleData cycle;
    Arc3d arc_3d;
    SkipState skip;
    PlaneCodes plane_codes;
    WrappedMotion wrapped;
    ReferencePoints reference_points;
    MCodes m_codes;
    ClockVariables clock;
    ProgramPlace place;
    DataEntry data_entry = DataEntry::none;
    bool moved = false;  ///< the block moved an axis: G66 calls follow it

    /// After a change of parameters: decodes settings, geometry and limits again.
    void parameters_changed();
};

}  // namespace trunnion::controller
