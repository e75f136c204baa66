# The subjects of the control, lowest first: a file may include only subjects that stand before its
# own. tests/layering.cmake reads this list.
set(TRUNNION_CONTROLLER_ORDER
  # what is configured, what can go wrong
  modal_groups g_codes missing_codes builder_profile variable_rounding clamp hurco_choices control_alarms alarms control_config run_result
  code_calls
  # the words of a block, what is in force
  sorted_words settings hurco_codes modal cautions run_record surface_speed word_sorting
  # where the control stands
  coordinates frames commanded
  # what takes a path to the axes
  feed_time axis_mover tool_vector tip_mover mover
  # codes by subject
  arcs arc_3d word_readings cutter_codes position_offset single_direction tool_measurement holes cycles wrapped_motion work_frames fixture_offset_codes tool_length
  tool_centre tilted_plane_codes transform_plane retract shapes reference_points skip data_setting dialect_codes m_codes
  # system variables
  offset_variables position_variables modal_variables signal_variables
  # put together
  control system_variables g_actions block_execution block_trial controller)
