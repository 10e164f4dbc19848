Shader disassembly is not supported in the current configuration, falling back to print_program.

After lowering to hw instructions:
ACO shader stage: SW (CS), HW (COMPUTE_SHADER)
BB0
/* logical preds: / linear preds: / kind: top-level, branch, */
	 v1: %6:v[1] = v_and_b32 7, %74:v[0]
	 v1: %9:v[0] = v_lshrrev_b32 10, %74:v[0]
	s_delay_alu valu_dep_2 skip_1 valu_dep_1
	 v1: %7:v[1] = v_lshl_add_u32 %75:s[117], 3, %6:v[1]
	 v1: %11:v[0] = v_lshl_add_u32 (is16bit)%76:s[115], 3, %9:v[0]
	 v1: %12:v[2] = v_min_i32 %11:v[0], %7:v[1]
	s_delay_alu valu_dep_1
	 s2: %0:exec = v_cmpx_le_i32 0, %12:v[2]
	s_cbranch_execz block:BB6
BB1
/* logical preds: BB0, / linear preds: BB0, / kind: uniform, */
	 s1: %0:s[0] = s_mov_b32 %73:s[2]
	 s1: %0:s[1] = s_movk_i32 imm:-32768
	 s4: %18:s[4-7] = s_load_dwordx4 %17:s[0-1], 0
	s_wait_kmcnt imm:0
	 s2: %20:s[0-1] = s_buffer_load_dwordx2 %18:s[4-7], 0x280
	s_wait_kmcnt imm:0
	 s1: %21:s[1] = s_cvt_i32_f32 %88:s[1]
	 s1: %22:s[0] = s_cvt_i32_f32 %87:s[0]
	 s2: %24:s[4-5] = v_cmp_gt_i32 (latekill)%21:s[1], %11:v[0]
	 s2: %23:vcc = v_cmp_gt_i32 (latekill)%22:s[0], %7:v[1]
	 s2: %25:s[0-1],  s1: %89:scc = s_and_b64 %24:s[4-5], %23:vcc
BB6
/* logical preds: BB1, BB0, / linear preds: BB1, BB0, / kind: top-level, branch, merge, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %140:s[0-1],  s1: %139:scc = s_and_b64 %138:s[0-1], %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec = s_mov_b64 %140:s[0-1]
	s_cbranch_execz block:BB18
BB7
/* logical preds: BB6, / linear preds: BB6, / kind: branch, */
	 s1: %0:s[3] = s_movk_i32 imm:-32768
	 s8: %32:s[8-15] = s_load_dwordx8 %31:s[2-3], 32
	s_wait_kmcnt imm:0
	 v3: %98:v[2-4] = image_load %32:s[8-15],  s4: undef,  v1: undef, %7:v[1], %11:v[0] dmask:xyw 2d unrm
	 s2: %0:s[0-1] = s_mov_b64 %0:exec
	s_wait_loadcnt imm:0
	 s2: %0:exec = v_cmpx_lt_f32 0, %101:v[4]
	s_cbranch_execz block:BB11
BB8
/* logical preds: BB7, / linear preds: BB7, / kind: uniform, */
	 s4: %36:s[4-7] = s_load_dwordx4 %31:s[2-3], 0
	s_wait_kmcnt imm:0
	s_clause imm:1
	 s2: %38:s[8-9] = s_buffer_load_dwordx2 %36:s[4-7], 0x280
	 s2: %42:s[4-5] = s_buffer_load_dwordx2 %36:s[4-7], 0x2a0
	 s8: %46:s[16-23] = s_load_dwordx8 %31:s[2-3], 0x80
	s_wait_kmcnt imm:0
	 v1: %43:v[2] = v_fma_f32 %106:s[8], %99:v[2], -%108:s[4]
	 v1: %44:v[3] = v_fma_f32 %107:s[9], %100:v[3], -%109:s[5]
	s_delay_alu valu_dep_2 skip_1 valu_dep_2
	 v1: %47:v[2] = v_floor_f32 %43:v[2]
	 v1: %48:v[3] = v_floor_f32 %44:v[3]
	 v1: %49:v[2] = v_cvt_i32_f32 %47:v[2]
	 v1: %50:v[3] = v_cvt_i32_f32 %48:v[3]
	 v3: %118:v[5-7] = image_load %46:s[16-23],  s4: undef,  v1: undef, %49:v[2], %50:v[3] 2d unrm
BB11
/* logical preds: BB7, / linear preds: BB8, BB7, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %144:scc = s_andn2_b64 %143:s[0-1], %0:exec
	s_wait_loadcnt imm:0
	 v1: %0:v[5] = v_mov_b32 0
	 v1: %0:v[6] = v_mov_b32 0
	 v1: %0:v[7] = v_mov_b32 0
BB13
/* logical preds: BB8, BB11, / linear preds: BB11, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %143:s[0-1]
	s_clause imm:1
	 s8: %60:s[8-15] = s_load_dwordx8 %31:s[2-3], 0xe0
	 s8: %67:s[0-7] = s_load_dwordx8 %31:s[2-3], 0x100
	 v1: %0:v[8] = v_mov_b32 1.0
	s_wait_kmcnt imm:0
	image_store %60:s[8-15],  s4: undef, %65:v[5-8], %7:v[1], %11:v[0] 2d unrm disable_wqm storage:image
	image_store %67:s[0-7],  s4: undef, %101:v[4], %7:v[1], %11:v[0] dmask:x 2d unrm disable_wqm storage:image
BB18
/* logical preds: BB13, BB6, / linear preds: BB13, BB6, / kind: uniform, top-level, merge, */
	s_nop
	s_sendmsg sendmsg(dealloc_vgprs)
	s_endpgm

