Shader disassembly is not supported in the current configuration, falling back to print_program.

After lowering to hw instructions:
ACO shader stage: SW (CS), HW (COMPUTE_SHADER)
BB0
/* logical preds: / linear preds: / kind: top-level, branch, */
	 v1: %6:v[1] = v_and_b32 7, %658:v[0]
	 v1: %9:v[0] = v_lshrrev_b32 10, %658:v[0]
	s_delay_alu valu_dep_2 skip_1 valu_dep_1
	 v1: %7:v[1] = v_lshl_add_u32 %659:s[117], 3, %6:v[1]
	 v1: %11:v[0] = v_lshl_add_u32 (is16bit)%660:s[115], 3, %9:v[0]
	 v1: %12:v[2] = v_min_i32 %11:v[0], %7:v[1]
	s_delay_alu valu_dep_1
	 s2: %0:exec = v_cmpx_le_i32 0, %12:v[2]
	s_cbranch_execz block:BB6
BB1
/* logical preds: BB0, / linear preds: BB0, / kind: uniform, */
	 s1: %0:s[0] = s_mov_b32 %657:s[2]
	 s1: %0:s[1] = s_movk_i32 imm:-32768
	 s4: %18:s[4-7] = s_load_dwordx4 %17:s[0-1], 0
	s_wait_kmcnt imm:0
	 s2: %20:s[0-1] = s_buffer_load_dwordx2 %18:s[4-7], 0x280
	s_wait_kmcnt imm:0
	 s1: %21:s[1] = s_cvt_i32_f32 %672:s[1]
	 s1: %22:s[0] = s_cvt_i32_f32 %671:s[0]
	 s2: %24:s[4-5] = v_cmp_gt_i32 (latekill)%21:s[1], %11:v[0]
	 s2: %23:vcc = v_cmp_gt_i32 (latekill)%22:s[0], %7:v[1]
	 s2: %25:s[0-1],  s1: %673:scc = s_and_b64 %24:s[4-5], %23:vcc
BB6
/* logical preds: BB1, BB0, / linear preds: BB1, BB0, / kind: top-level, branch, merge, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %885:s[0-1],  s1: %884:scc = s_and_b64 %883:s[0-1], %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec = s_mov_b64 %885:s[0-1]
	s_cbranch_execz block:BB169
BB7
/* logical preds: BB6, / linear preds: BB6, / kind: branch, */
	 s1: %0:s[3] = s_movk_i32 imm:-32768
	s_clause imm:1
	 s8: %32:s[8-15] = s_load_dwordx8 %31:s[2-3], 32
	 s4: %35:s[4-7] = s_load_dwordx4 %31:s[2-3], 0
	s_wait_kmcnt imm:0
	 v1: %682:v[2] = image_load %32:s[8-15],  s4: undef,  v1: undef, %7:v[1], %11:v[0] 2d unrm
	 s4: %37:s[16-19] = s_load_dwordx4 %31:s[2-3], 16
	 s1: %39:s[0] = s_buffer_load_dword %35:s[4-7], 0x298
	 s2: %0:s[20-21] = s_mov_b64 %0:exec
	s_wait_loadcnt imm:0
	s_wait_kmcnt imm:0
	 s2: %0:exec = v_cmpx_neq_f32 (latekill)%39:s[0], %682:v[2]
	s_cbranch_execz block:BB19
BB8
/* logical preds: BB7, / linear preds: BB7, / kind: branch, */
	 s8: %42:s[24-31] = s_load_dwordx8 %31:s[2-3], 0x1a0
	s_wait_kmcnt imm:0
	 v1: %699:v[3] = image_load %42:s[24-31],  s4: undef,  v1: undef, %7:v[1], %11:v[0] dmask:w 2d unrm
	s_wait_loadcnt imm:0
	 s2: (precise)%44:vcc = v_cmp_lt_f32 0, %699:v[3]
	 s2: %45:s[22-23],  s1: %700:scc = s_not_b64 %44:vcc
	s_delay_alu salu_cycle_1
	 s2: %937:s[22-23],  s1: %936:scc,  s2: %0:exec = s_and_saveexec_b64 %45:s[22-23], %0:exec
	s_cbranch_execz block:BB12
BB9
/* logical preds: BB8, / linear preds: BB8, / kind: uniform, */
	 s8: %47:s[24-31] = s_load_dwordx8 %31:s[2-3], 0x140
	s_wait_kmcnt imm:0
	 v1: %709:v[3] = image_load %47:s[24-31],  s4: undef,  v1: undef, %7:v[1], %11:v[0] dmask:w 2d unrm
	s_wait_loadcnt imm:0
	 s2: (precise)%49:s[24-25] = v_cmp_lt_f32 0, %709:v[3]
BB12
/* logical preds: BB8, / linear preds: BB9, BB8, / kind: uniform, */
	 s2: %0:exec,  s1: %938:scc = s_andn2_b64 %937:s[22-23], %0:exec
	s_delay_alu salu_cycle_1 skip_1 salu_cycle_1
	 s2: %889:s[24-25],  s1: %888:scc = s_andn2_b64 %887:s[24-25], %0:exec
	 s2: %891:s[26-27],  s1: %890:scc = s_and_b64 %44:vcc, %0:exec
	 s2: %886:s[24-25],  s1: %892:scc = s_or_b64 %889:s[24-25], %891:s[26-27]
BB14
/* logical preds: BB9, BB12, / linear preds: BB12, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %937:s[22-23]
BB19
/* logical preds: BB14, BB7, / linear preds: BB14, BB7, / kind: branch, merge, */
	s_delay_alu salu_cycle_1 skip_1 salu_cycle_1
	 s2: %895:s[22-23],  s1: %894:scc = s_and_b64 %893:s[24-25], %0:exec
	 s2: %0:exec = s_mov_b64 %935:s[20-21]
	 s2: %0:exec,  s1: %940:scc = s_and_b64 %895:s[22-23], %0:exec
	s_cbranch_execz block:BB25
BB20
/* logical preds: BB19, / linear preds: BB19, / kind: uniform, */
	 s8: %54:s[24-31] = s_load_dwordx8 %31:s[2-3], 0xe0
	s_wait_kmcnt imm:0
	 v1: %718:v[3] = image_load %54:s[24-31],  s4: undef,  v1: undef, %7:v[1], %11:v[0] dmask:w 2d unrm
	 s1: %56:s[1] = s_buffer_load_dword %37:s[16-19], 0
	s_wait_loadcnt imm:0
	s_wait_kmcnt imm:0
	 s2: (precise)%57:vcc = v_cmp_ge_f32 (latekill)%56:s[1], %718:v[3]
BB25
/* logical preds: BB20, BB19, / linear preds: BB20, BB19, / kind: branch, merge, */
	 s2: %898:s[22-23],  s1: %897:scc = s_and_b64 %896:vcc, %0:exec
	 s2: %0:exec = s_mov_b64 %935:s[20-21]
	s_delay_alu salu_cycle_1
	 s2: %0:exec,  s1: %942:scc = s_and_b64 %898:s[22-23], %0:exec
	s_cbranch_execz block:BB162
BB26
/* logical preds: BB25, / linear preds: BB25, / kind: uniform, */
	 s8: %112:s[24-31] = s_load_dwordx8 %31:s[2-3], 0xe0
	s_wait_kmcnt imm:0
	 v3: %757:v[3-5] = image_load %112:s[24-31],  s4: undef,  v1: undef, %7:v[1], %11:v[0] 2d unrm
	s_clause imm:6
	 s2: %61:s[22-23] = s_buffer_load_dwordx2 %35:s[4-7], 0x2a0
	 s4: %70:s[24-27] = s_buffer_load_dwordx4 %35:s[4-7], 0x280
	 s16: %77:s[32-47] = s_buffer_load_dwordx16 %35:s[4-7], 64
	 s1: %105:s[1] = s_buffer_load_dword %35:s[4-7], 0x2b8
	 s4: %761:s[28-31] = s_buffer_load_dwordx4 %35:s[4-7], 0xa0
	 s4: %766:s[48-51] = s_buffer_load_dwordx4 %35:s[4-7], 0x90
	 s4: %771:s[52-55] = s_buffer_load_dwordx4 %35:s[4-7], 0x80
	 s1: %147:s[56] = s_buffer_load_dword %37:s[16-19], 28
	 v1: %62:v[6] = v_cvt_f32_i32 %7:v[1]
	 v1: %66:v[7] = v_cvt_f32_i32 %11:v[0]
	s_delay_alu valu_dep_2 skip_2 valu_dep_2
	 v1: %64:v[6] = v_add_f32 0.5, %62:v[6]
	 v1: %67:v[7] = v_add_f32 0.5, %66:v[7]
	s_wait_kmcnt imm:0
	 v1: %72:v[6] = v_add_f32 %719:s[22], %64:v[6] *2
	 v1: %74:v[7] = v_add_f32 %720:s[23], %67:v[7] *2
	 v1: %78:v[8] = v_fma_f32 %733:s[40], %682:v[2], %737:s[44]
	 v1: %79:v[9] = v_fma_f32 %734:s[41], %682:v[2], %738:s[45]
	 v1: %80:v[10] = v_fma_f32 %735:s[42], %682:v[2], %739:s[46]
	 v1: %81:v[2] = v_fma_f32 %736:s[43], %682:v[2], %740:s[47]
	 s1: %745:scc = s_cmp_eq_i32 %105:s[1], 1
	 v1: %88:v[6] = v_fma_f32 %723:s[26], %72:v[6], -1.0
	 v1: %83:v[7] = v_fma_f32 %724:s[27], %74:v[7], -1.0
	s_delay_alu valu_dep_1
	 v1: %84:v[8] = v_fmac_f32 %729:s[36], %83:v[7], %78:v[8]
	 v1: %85:v[9] = v_fmac_f32 %730:s[37], %83:v[7], %79:v[9]
	 s2: %107:s[36-37] = s_cselect_b64 -1, 0, %745:scc
	 v1: %86:v[10] = v_fmac_f32 %731:s[38], %83:v[7], %80:v[10]
	 v1: %87:v[2] = v_fmac_f32 %732:s[39], %83:v[7], %81:v[2]
	 v1: %89:v[8] = v_fmac_f32 %725:s[32], %88:v[6], %84:v[8]
	 v1: %90:v[9] = v_fmac_f32 %726:s[33], %88:v[6], %85:v[9]
	s_delay_alu valu_dep_4 skip_2 valu_dep_1
	 v1: %91:v[10] = v_fmac_f32 %727:s[34], %88:v[6], %86:v[10]
	 v1: %92:v[2] = v_fmac_f32 %728:s[35], %88:v[6], %87:v[2]
	 s1: (precise)%776:scc = s_cmp_lt_f32 0, %147:s[56]
	 v1: %93:v[2] = v_rcp_f32 %92:v[2]
	s_delay_alu trans32_dep_1 skip_2 valu_dep_1
	 v1: %94:v[8] = v_mul_f32 %89:v[8], %93:v[2]
	 v1: %95:v[9] = v_mul_f32 %90:v[9], %93:v[2]
	 v1: %96:v[10] = v_mul_f32 %91:v[10], %93:v[2]
	 v1: %97:v[11] = v_mul_f32 %96:v[10], %96:v[10]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %98:v[11] = v_fmac_f32 %95:v[9], %95:v[9], %97:v[11]
	 v1: %99:v[11] = v_fmac_f32 %94:v[8], %94:v[8], %98:v[11]
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %100:v[11] = v_rsq_f32 %99:v[11]
	 v1: %101:v[12] = v_mul_f32 %94:v[8], %100:v[11]
	 v1: %102:v[13] = v_mul_f32 %95:v[9], %100:v[11]
	 v1: %103:v[11] = v_mul_f32 %96:v[10], %100:v[11]
	s_waitcnt_depctr sa_sdst(0)
	s_delay_alu valu_dep_3
	 v1: %108:v[12] = v_cndmask_b32 %101:v[12], 0, %107:s[36-37]
	 v1: %109:v[13] = v_cndmask_b32 %102:v[13], 0, %107:s[36-37]
	 v1: %110:v[11] = v_cndmask_b32 %103:v[11], -1.0, %107:s[36-37]
	s_wait_loadcnt imm:0
	 v1: %116:v[14] = v_mul_f32 %762:s[28], %760:v[5]
	 v1: %117:v[15] = v_mul_f32 %763:s[29], %760:v[5]
	 v1: %118:v[5] = v_mul_f32 %764:s[30], %760:v[5]
	s_delay_alu valu_dep_3 skip_2 valu_dep_3
	 v1: %121:v[14] = v_fmac_f32 %767:s[48], %759:v[4], %116:v[14]
	 v1: %122:v[15] = v_fmac_f32 %768:s[49], %759:v[4], %117:v[15]
	 v1: %123:v[5] = v_fmac_f32 %769:s[50], %759:v[4], %118:v[5]
	 v1: %126:v[14] = v_fmac_f32 %772:s[52], %758:v[3], %121:v[14]
	 v1: %127:v[15] = v_fmac_f32 %773:s[53], %758:v[3], %122:v[15]
	 v1: %128:v[5] = v_fmac_f32 %774:s[54], %758:v[3], %123:v[5]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %129:v[16] = v_mul_f32 %128:v[5], %128:v[5]
	 v1: %130:v[16] = v_fmac_f32 %127:v[15], %127:v[15], %129:v[16]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %131:v[16] = v_fmac_f32 %126:v[14], %126:v[14], %130:v[16]
	 v1: %132:v[16] = v_rsq_f32 %131:v[16]
	s_delay_alu trans32_dep_1 skip_2 valu_dep_1
	 v1: %134:v[15] = v_mul_f32 %127:v[15], %132:v[16]
	 v1: %133:v[14] = v_mul_f32 %126:v[14], %132:v[16]
	 v1: %135:v[5] = v_mul_f32 %128:v[5], %132:v[16]
	 v1: %136:v[17] = v_mul_f32 %110:v[11], %135:v[5]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %137:v[17] = v_fmac_f32 %109:v[13], %134:v[15], %136:v[17]
	 v1: %140:v[17] = v_fma_f32 %108:v[12], %133:v[14], %137:v[17] *2
	s_delay_alu valu_dep_1
	 v1: %141:v[14] = v_fma_f32 -%133:v[14], %140:v[17], %108:v[12]
	 v1: %143:v[15] = v_fma_f32 -%134:v[15], %140:v[17], %109:v[13]
	 v1: %145:v[5] = v_fma_f32 -%135:v[5], %140:v[17], %110:v[11]
	s_cbranch_scc1 block:BB29
BB27
/* logical preds: BB26, / linear preds: BB26, / kind: uniform, */
	 s1: %151:s[1] = s_buffer_load_dword %35:s[4-7], 0x294
	s_wait_kmcnt imm:0
	 s1: %152:s[56] = s_mul_f32 2.0, %151:s[1]
BB29
/* logical preds: BB27, BB26, / linear preds: BB27, BB26, / kind: uniform, loop-preheader, */
	s_clause imm:1
	 s1: %157:s[28] = s_buffer_load_dword %35:s[4-7], 0x290
	 s16: %171:s[64-79] = s_buffer_load_dwordx16 %35:s[4-7], 0
	s_clause imm:1
	 s4: %813:s[4-7] = s_buffer_load_dwordx4 %37:s[16-19], 4
	 s1: %320:s[29] = s_buffer_load_dword %37:s[16-19], 24
	 v1: %160:v[3] = v_rcp_f32 %145:v[5]
	 s1: %218:s[30] = s_cselect_b32 3, 4, %776:scc
	 s1: %0:s[31] = s_mov_b32 0x3c23d70a
	 v1: %155:v[2] = v_fma_f32 %153:s[56], %145:v[5], %96:v[10]
	s_wait_kmcnt imm:0
	 s1: %158:s[32] = s_mul_f32 -1.0, %157:s[28]
	 s1: %217:s[28] = s_mul_f32 0xbf800347, %157:s[28]
	 v1: %172:v[6] = v_fma_f32 %789:s[72], %96:v[10], %793:s[76]
	 v1: %173:v[7] = v_fma_f32 %790:s[73], %96:v[10], %794:s[77]
	 v1: %174:v[11] = v_fma_f32 %792:s[75], %96:v[10], %796:s[79]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %159:v[4] = v_sub_f32 %158:s[32], %96:v[10]
	 s2: (precise)%163:vcc = v_cmp_lt_f32 (latekill)%158:s[32], %155:v[2]
	 v1: %175:v[6] = v_fmac_f32 %785:s[68], %95:v[9], %172:v[6]
	 v1: %176:v[7] = v_fmac_f32 %786:s[69], %95:v[9], %173:v[7]
	 v1: %177:v[11] = v_fmac_f32 %788:s[71], %95:v[9], %174:v[11]
	 v1: %161:v[4] = v_mul_f32 %159:v[4], %160:v[3]
	s_delay_alu valu_dep_4 skip_3 valu_dep_2
	 v1: %181:v[6] = v_fma_f32 %781:s[64], %94:v[8], %175:v[6] *0.5
	 v1: %184:v[7] = v_fma_f32 %782:s[65], %94:v[8], %176:v[7] *0.5
	 v1: %180:v[11] = v_fmac_f32 %784:s[67], %94:v[8], %177:v[11]
	 v1: %162:v[4] = v_max_f32 0, %161:v[4]
	 v1: %182:v[11] = v_rcp_f32 %180:v[11]
	 v1: %164:v[4] = v_cndmask_b32 %153:s[56], %162:v[4], %163:vcc
	s_delay_alu valu_dep_1
	 v1: %170:v[5] = v_fma_f32 %145:v[5], %164:v[4], %96:v[10]
	 v1: %168:v[14] = v_fma_f32 %141:v[14], %164:v[4], %94:v[8]
	 v1: %169:v[15] = v_fma_f32 %143:v[15], %164:v[4], %95:v[9]
	 v1: %191:v[13] = v_mul_f32 %95:v[9], %182:v[11]
	 v1: %186:v[6] = v_fma_f32 %181:v[6], %182:v[11], 0.5
	 v1: %190:v[12] = v_mul_f32 %94:v[8], %182:v[11]
	 v1: %192:v[16] = v_mul_f32 %96:v[10], %182:v[11]
	 v1: %188:v[7] = v_fma_f32 %184:v[7], %182:v[11], 0.5
	 v1: %194:v[18] = v_fma_f32 %790:s[73], %170:v[5], %794:s[77]
	 v1: %195:v[19] = v_fma_f32 %792:s[75], %170:v[5], %796:s[79]
	 v1: %193:v[17] = v_fma_f32 %789:s[72], %170:v[5], %793:s[76]
	 s1: %298:s[33] = v_s_rcp_f32 %815:s[5]
	 s1: %303:s[4] = s_cvt_f32_u32 %814:s[4]
	 s1: (precise)%818:scc = s_cmp_eq_f32 %815:s[5], 0
	 s1: %308:s[36] = s_add_f32 %816:s[6], -0.5
	 v1: %187:v[6] = v_mul_f32 %721:s[24], %186:v[6]
	 v1: %189:v[7] = v_mul_f32 %722:s[25], %188:v[7]
	 v1: %197:v[18] = v_fmac_f32 %786:s[69], %169:v[15], %194:v[18]
	 v1: %198:v[19] = v_fmac_f32 %788:s[71], %169:v[15], %195:v[19]
	 v1: %196:v[17] = v_fmac_f32 %785:s[68], %169:v[15], %193:v[17]
	 s2: %306:s[34-35] = s_cselect_b64 -1, 0, %818:scc
	 s2: (precise)%219:vcc = v_cmp_le_f32 (latekill)%217:s[28], %170:v[5]
	s_waitcnt_depctr sa_sdst(0)
	 s1: %309:s[36] = s_max_f32 %308:s[36], 0
	 s1: %224:s[37] = s_add_f32 %721:s[24], -0.5
	 v1: %205:v[18] = v_fma_f32 %782:s[65], %168:v[14], %197:v[18] *0.5
	 v1: %201:v[19] = v_fmac_f32 %784:s[67], %168:v[14], %198:v[19]
	 v1: %202:v[17] = v_fma_f32 %781:s[64], %168:v[14], %196:v[17] *0.5
	s_waitcnt_depctr va_vcc(0)
	 v1: %220:v[21] = v_cndmask_b32 %218:s[30], 2, %219:vcc
	s_delay_alu valu_dep_3 next trans32_dep_1
	 v1: %203:v[19] = v_rcp_f32 %201:v[19]
	 v1: %211:v[14] = v_mul_f32 %168:v[14], %203:v[19]
	 v1: %207:v[17] = v_fma_f32 %202:v[17], %203:v[19], 0.5
	 v1: %213:v[20] = v_mul_f32 %170:v[5], %203:v[19]
	 v1: %212:v[15] = v_mul_f32 %169:v[15], %203:v[19]
	 v1: %209:v[18] = v_fma_f32 %205:v[18], %203:v[19], 0.5
	 s1: %238:s[38] = s_add_f32 %722:s[25], -0.5
	 v1: %208:v[17] = v_mul_f32 %721:s[24], %207:v[17]
	s_delay_alu valu_dep_2 next valu_dep_2
	 v1: %210:v[18] = v_mul_f32 %722:s[25], %209:v[18]
	 s2: (precise)%221:vcc = v_cmp_gt_f32 0.5, %208:v[17]
	 v1: %228:v[23] = v_sub_f32 %208:v[17], %187:v[6]
	s_delay_alu valu_dep_3
	 v1: %242:v[25] = v_sub_f32 %210:v[18], %189:v[7]
	s_waitcnt_depctr va_vcc(0)
	 v1: %222:v[22] = v_cndmask_b32 %208:v[17], 0.5, %221:vcc
	s_waitcnt_depctr sa_sdst(0)
	 s2: (precise)%225:vcc = v_cmp_lt_f32 (latekill)%224:s[37], %208:v[17]
	 v1: %229:v[23] = v_rcp_f32 %228:v[23]
	 v1: %243:v[25] = v_rcp_f32 %242:v[25]
	 v1: %251:v[26] = v_sub_f32 %187:v[6], %208:v[17]
	s_waitcnt_depctr va_vcc(0)
	 v1: %226:v[22] = v_cndmask_b32 %222:v[22], %224:s[37], %225:vcc
	 v1: %254:v[27] = v_sub_f32 %189:v[7], %210:v[18]
	 v1: %257:v[28] = v_sub_f32 %190:v[12], %211:v[14]
	s_delay_alu valu_dep_3 skip_1 valu_dep_2
	 v1: %227:v[22] = v_sub_f32 %208:v[17], %226:v[22]
	 v1: %260:v[29] = v_sub_f32 %191:v[13], %212:v[15]
	 s2: (precise)%234:vcc = v_cmp_lt_f32 (latekill)%233:s[31], |%227:v[22]|
	 v1: %231:v[23] = v_mul_f32 %227:v[22], %229:v[23] clamp
	 v1: %263:v[30] = v_sub_f32 %192:v[16], %213:v[20]
	 v1: %266:v[31] = v_sub_f32 %182:v[11], %203:v[19]
	s_waitcnt_depctr va_vcc(0)
	s_delay_alu valu_dep_3
	 v1: %235:v[23] = v_cndmask_b32 0, %231:v[23], %234:vcc
	 s2: (precise)%236:vcc = v_cmp_gt_f32 0.5, %210:v[18]
	s_waitcnt_depctr va_vcc(0)
	 v1: %237:v[24] = v_cndmask_b32 %210:v[18], 0.5, %236:vcc
	 s2: (precise)%239:vcc = v_cmp_lt_f32 (latekill)%238:s[38], %210:v[18]
	s_waitcnt_depctr va_vcc(0)
	 v1: %240:v[24] = v_cndmask_b32 %237:v[24], %238:s[38], %239:vcc
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %241:v[24] = v_sub_f32 %210:v[18], %240:v[24]
	 s2: (precise)%249:vcc = v_cmp_lt_f32 (latekill)%233:s[31], |%241:v[24]|
	 v1: %244:v[25] = v_mul_f32 %241:v[24], %243:v[25]
	 v1: %275:v[34] = v_add_f32 %233:s[31], %187:v[6]
	s_delay_alu valu_dep_2 skip_2 valu_dep_2
	 v1: %247:v[25] = v_minmax_f32 1.0, %244:v[25], %235:v[23]
	 v1: %279:v[35] = v_add_f32 %233:s[31], %189:v[7]
	s_waitcnt_depctr va_vcc(0)
	 v1: %250:v[23] = v_cndmask_b32 %235:v[23], %247:v[25], %249:vcc
	s_delay_alu valu_dep_1
	 v1: %259:v[14] = v_fmac_f32 %250:v[23], %257:v[28], %211:v[14]
	 s2: (precise)%269:vcc = v_cmp_lt_f32 0, %250:v[23]
	 v1: %256:v[18] = v_fmac_f32 %250:v[23], %254:v[27], %210:v[18]
	 v1: %268:v[19] = v_fmac_f32 %250:v[23], %266:v[31], %203:v[19]
	 v1: %253:v[17] = v_fmac_f32 %250:v[23], %251:v[26], %208:v[17]
	 v1: %265:v[20] = v_fmac_f32 %250:v[23], %263:v[30], %213:v[20]
	 v1: %262:v[15] = v_fmac_f32 %250:v[23], %260:v[29], %212:v[15]
	 v1: %289:v[14] = v_sub_f32 %259:v[14], %190:v[12]
	s_waitcnt_depctr va_vcc(0)
	 v1: %270:v[21] = v_cndmask_b32 %220:v[21], 1, %269:vcc
	 v1: %272:v[33] = v_sub_f32 %256:v[18], %189:v[7]
	 v1: %271:v[32] = v_sub_f32 %253:v[17], %187:v[6]
	 v1: %291:v[20] = v_sub_f32 %265:v[20], %192:v[16]
	 v1: %295:v[19] = v_sub_f32 %268:v[19], %182:v[11]
	 v1: %290:v[15] = v_sub_f32 %262:v[15], %191:v[13]
	 v1: %299:v[38] = v_mul_f32 %298:s[33], %96:v[10]
	 v1: %273:v[33] = v_mul_f32 %272:v[33], %272:v[33]
	s_delay_alu valu_dep_2 skip_1 valu_dep_2
	 v1: %301:v[38] = v_min_f32 1.0, -%299:v[38]
	 v1: %274:v[33] = v_fmac_f32 %271:v[32], %271:v[32], %273:v[33]
	 v1: %302:v[39] = v_sub_f32 1.0, %301:v[38]
	 s2: (precise)%277:vcc = v_cmp_gt_f32 0x38d1b717, %274:v[33]
	s_delay_alu valu_dep_2 skip_3 valu_dep_3
	 v1: %305:v[38] = v_fmac_f32 %303:s[4], %302:v[39], %301:v[38]
	s_waitcnt_depctr va_vcc(0)
	 v1: %278:v[17] = v_cndmask_b32 %253:v[17], %275:v[34], %277:vcc
	 v1: %280:v[18] = v_cndmask_b32 %256:v[18], %279:v[35], %277:vcc
	 v1: %307:v[38] = v_cndmask_b32 %305:v[38], %303:s[4], %306:s[34-35]
	 v1: %281:v[17] = v_sub_f32 %278:v[17], %187:v[6]
	 v1: %282:v[18] = v_sub_f32 %280:v[18], %189:v[7]
	 s2: %0:s[4-5] = s_mov_b64 %0:exec
	 v1: %0:v[2] = v_mov_b32 -1
	 v1: %0:v[3] = v_mov_b32 0
	 s1: %0:s[1] = s_mov_b32 0
	 s2: %0:s[30-31] = s_mov_b64 0
	 v1: %310:v[40] = v_mul_f32 %309:s[36], %307:v[38]
	 v1: %285:v[36] = v_max_f32 |%281:v[17]|, |%282:v[18]|
	s_delay_alu valu_dep_1 skip_1 trans32_dep_1
	 v1: %286:v[37] = v_rcp_f32 %285:v[36]
	 v1: %311:v[40] = v_min_f32 %310:v[40], %285:v[36]
	 v1: %287:v[17] = v_mul_f32 %281:v[17], %286:v[37]
	 v1: %292:v[14] = v_mul_f32 %289:v[14], %286:v[37]
	 v1: %294:v[20] = v_mul_f32 %291:v[20], %286:v[37]
	 v1: %293:v[15] = v_mul_f32 %290:v[15], %286:v[37]
	 v1: %288:v[18] = v_mul_f32 %282:v[18], %286:v[37]
	 v1: %296:v[19] = v_mul_f32 %295:v[19], %286:v[37]
	s_delay_alu valu_dep_4 next valu_dep_2
	 v1: %313:v[41] = v_fma_f32 %294:v[20], %311:v[40], %192:v[16]
	 v1: %315:v[40] = v_fma_f32 %296:v[19], %311:v[40], %182:v[11]
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %316:v[40] = v_rcp_f32 %315:v[40]
	 v1: %317:v[41] = v_mul_f32 %313:v[41], %316:v[40]
BB30
/* logical preds: BB29, BB158, / linear preds: BB29, BB158, / kind: loop-header, branch, */
	s_waitcnt_depctr sa_sdst(0)
	 s1: %820:scc = s_cmp_lt_u32 %321:s[1], %320:s[29]
	 s2: %326:vcc = v_cmp_eq_i32 -1, %323:v[2]
	 s2: %325:s[32-33] = s_cselect_b64 -1, 0, %820:scc
	s_waitcnt_depctr sa_sdst(0)
	 s2: %327:s[32-33],  s1: %821:scc = s_and_b64 %325:s[32-33], %326:vcc
	s_waitcnt_depctr sa_sdst(0)
	 s2: %328:s[34-35],  s1: %822:scc = s_not_b64 %327:s[32-33]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %945:s[34-35],  s1: %944:scc,  s2: %0:exec = s_and_saveexec_b64 %328:s[34-35], %0:exec
BB31
/* logical preds: BB30, / linear preds: BB30, / kind: break, */
	s_delay_alu salu_cycle_1
	 s2: %927:s[36-37],  s1: %926:scc = s_and_b64 %326:vcc, %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 s2: %923:s[30-31],  s1: %928:scc = s_or_b64 %924:s[30-31], %927:s[36-37]
	 s2: %947:s[34-35],  s1: %946:scc = s_andn2_b64 %945:s[34-35], %0:exec
	s_cbranch_scc0 block:BB159
BB38
/* logical preds: BB30, / linear preds: BB31, / kind: branch, merge, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec = s_mov_b64 %948:s[34-35]
	 s1: %329:s[7] = s_cvt_f32_u32 %321:s[1]
	 s1: %341:s[28] = s_cvt_i32_f32 %721:s[24]
	 s1: %346:s[37] = s_cvt_i32_f32 %722:s[25]
	 v1: %334:v[5] = v_subrev_f32 %719:s[22], %187:v[6]
	 v1: %336:v[23] = v_subrev_f32 %720:s[23], %189:v[7]
	s_waitcnt_depctr sa_sdst(0)
	 s1: %330:s[7] = s_add_f32 %816:s[6], %329:s[7]
	s_waitcnt_depctr sa_sdst(0)
	 s1: %342:s[36],  s1: %823:scc = s_add_u32 %341:s[28], -1
	 s1: %347:s[38],  s1: %824:scc = s_add_u32 %346:s[37], -1
	 v1: %331:v[4] = v_mul_f32 %330:s[7], %307:v[38]
	s_delay_alu valu_dep_1 skip_1 valu_dep_2
	 v1: %335:v[22] = v_fma_f32 %287:v[17], %331:v[4], %334:v[5]
	 v1: %337:v[24] = v_fma_f32 %288:v[18], %331:v[4], %336:v[23]
	 v1: %338:v[22] = v_floor_f32 %335:v[22]
	 v1: %344:v[24] = v_floor_f32 %337:v[24]
	s_delay_alu valu_dep_2
	 v1: %339:v[22] = v_cvt_i32_f32 %338:v[22]
	 v1: %345:v[24] = v_cvt_i32_f32 %344:v[24]
	 s1: %352:s[39],  s1: %826:scc = s_add_u32 %321:s[1], 1
	s_waitcnt_depctr sa_sdst(0)
	 s1: %353:s[40] = s_cvt_f32_u32 %352:s[39]
	s_wait_loadcnt imm:3
	 v1: %343:v[25] = v_maxmin_i32 0, %339:v[22], %342:s[36]
	 v1: %349:v[26] = v_maxmin_i32 0, %345:v[24], %347:s[38]
	s_waitcnt_depctr sa_sdst(0)
	 s1: %354:s[40] = s_add_f32 %816:s[6], %353:s[40]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %355:v[27] = v_mul_f32 %354:s[40], %307:v[38]
	s_delay_alu valu_dep_1 skip_1 valu_dep_2
	 v1: %359:v[29] = v_fma_f32 %288:v[18], %355:v[27], %336:v[23]
	 v1: %358:v[28] = v_fma_f32 %287:v[17], %355:v[27], %334:v[5]
	 v1: %364:v[29] = v_floor_f32 %359:v[29]
	 v1: %360:v[28] = v_floor_f32 %358:v[28]
	s_delay_alu valu_dep_2 skip_1 valu_dep_2
	 v1: %365:v[29] = v_cvt_i32_f32 %364:v[29]
	 v1: %361:v[28] = v_cvt_i32_f32 %360:v[28]
	 v1: %367:v[31] = v_maxmin_i32 0, %365:v[29], %347:s[38]
	 s1: %370:s[41],  s1: %828:scc = s_add_u32 %321:s[1], 2
	s_wait_loadcnt imm:2
	 v1: %363:v[30] = v_maxmin_i32 0, %361:v[28], %342:s[36]
	s_waitcnt_depctr sa_sdst(0)
	 s1: %371:s[44] = s_cvt_f32_u32 %370:s[41]
	s_waitcnt_depctr sa_sdst(0)
	 s1: %372:s[44] = s_add_f32 %816:s[6], %371:s[44]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %373:v[32] = v_mul_f32 %372:s[44], %307:v[38]
	s_delay_alu valu_dep_1 skip_1 valu_dep_2
	 v1: %377:v[34] = v_fma_f32 %288:v[18], %373:v[32], %336:v[23]
	 v1: %376:v[33] = v_fma_f32 %287:v[17], %373:v[32], %334:v[5]
	 v1: %382:v[34] = v_floor_f32 %377:v[34]
	 v1: %378:v[33] = v_floor_f32 %376:v[33]
	s_delay_alu valu_dep_2 skip_1 valu_dep_2
	 v1: %383:v[34] = v_cvt_i32_f32 %382:v[34]
	 v1: %379:v[33] = v_cvt_i32_f32 %378:v[33]
	 v1: %385:v[37] = v_maxmin_i32 0, %383:v[34], %347:s[38]
	s_wait_loadcnt imm:1
	 v1: %381:v[35] = v_maxmin_i32 0, %379:v[33], %342:s[36]
	 s1: %388:s[45],  s1: %830:scc = s_add_u32 %321:s[1], 3
	s_waitcnt_depctr sa_sdst(0)
	 s1: %389:s[48] = s_cvt_f32_u32 %388:s[45]
	s_waitcnt_depctr sa_sdst(0)
	 s1: %390:s[48] = s_add_f32 %816:s[6], %389:s[48]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %391:v[39] = v_mul_f32 %390:s[48], %307:v[38]
	s_delay_alu valu_dep_1 skip_1 valu_dep_2
	 v1: %394:v[5] = v_fmac_f32 %287:v[17], %391:v[39], %334:v[5]
	 v1: %395:v[23] = v_fmac_f32 %288:v[18], %391:v[39], %336:v[23]
	 v1: %396:v[5] = v_floor_f32 %394:v[5]
	 v1: %400:v[23] = v_floor_f32 %395:v[23]
	s_delay_alu valu_dep_2 skip_2 valu_dep_2
	 v1: %397:v[5] = v_cvt_i32_f32 %396:v[5]
	 v1: %401:v[23] = v_cvt_i32_f32 %400:v[23]
	s_wait_loadcnt imm:0
	 v1: %399:v[40] = v_maxmin_i32 0, %397:v[5], %342:s[36]
	 v1: %403:v[42] = v_maxmin_i32 0, %401:v[23], %347:s[38]
	s_clause imm:3
	 v1: %825:v[25] = image_load %32:s[8-15],  s4: undef,  v1: undef, %343:v[25], %349:v[26] 2d unrm
	 v1: %827:v[30] = image_load %32:s[8-15],  s4: undef,  v1: undef, %363:v[30], %367:v[31] 2d unrm
	 v1: %829:v[35] = image_load %32:s[8-15],  s4: undef,  v1: undef, %381:v[35], %385:v[37] 2d unrm
	 v1: %831:v[40] = image_load %32:s[8-15],  s4: undef,  v1: undef, %399:v[40], %403:v[42] 2d unrm
	 s2: %0:exec,  s1: %950:scc = s_and_b64 %327:s[32-33], %0:exec
	s_cbranch_execz block:BB68
BB39
/* logical preds: BB38, / linear preds: BB38, / kind: branch, */
	 s2: %0:s[32-33] = s_mov_b64 %0:exec
	 s2: %0:exec = v_cmpx_nlt_f32 %285:v[36], %331:v[4]
	s_cbranch_execz block:BB61
BB40
/* logical preds: BB39, / linear preds: BB39, / kind: branch, */
	 v1: %407:v[2] = v_min_i32 %345:v[24], %339:v[22]
	 s2: %408:vcc = v_cmp_gt_i32 (latekill)%341:s[28], %339:v[22]
	 s2: %409:s[50-51] = v_cmp_gt_i32 (latekill)%346:s[37], %345:v[24]
	 s2: %410:s[50-51],  s1: %832:scc = s_and_b64 %409:s[50-51], %408:vcc
	 s2: %411:vcc = v_cmp_le_i32 0, %407:v[2]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %412:s[50-51],  s1: %833:scc = s_and_b64 %411:vcc, %410:s[50-51]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %954:s[50-51],  s1: %953:scc,  s2: %0:exec = s_and_saveexec_b64 %412:s[50-51], %0:exec
	s_cbranch_execz block:BB56
BB41
/* logical preds: BB40, / linear preds: BB40, / kind: branch, */
	 s1: %413:s[7] = s_add_f32 0.5, %330:s[7]
	 s2: %0:s[52-53] = s_mov_b64 %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 v1: %414:v[2] = v_mul_f32 %413:s[7], %307:v[38]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %415:v[2] = v_min_f32 %414:v[2], %285:v[36]
	 v1: %417:v[3] = v_fma_f32 %294:v[20], %415:v[2], %192:v[16]
	 v1: %419:v[2] = v_fma_f32 %296:v[19], %415:v[2], %182:v[11]
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %420:v[2] = v_rcp_f32 %419:v[2]
	 v1: %421:v[3] = v_mul_f32 %417:v[3], %420:v[2]
	s_delay_alu valu_dep_1
	 v1: %422:v[22] = v_min_f32 %324:v[41], %421:v[3]
	 v1: %423:v[41] = v_max_f32 %324:v[41], %421:v[3]
	s_wait_loadcnt imm:3
	 s2: %0:exec = v_cmpx_eq_f32 (latekill)%39:s[0], %825:v[25]
BB42
/* logical preds: BB41, / linear preds: BB41, / kind: uniform, */
	 s2: %0:s[54-55] = s_mov_b64 0
	 s2: %0:exec,  s1: %957:scc = s_andn2_b64 %956:s[52-53], %0:exec
	s_cbranch_execz block:BB53
BB45
/* logical preds: BB41, / linear preds: BB42, / kind: branch, */
	 v1: %426:v[2] = v_fma_f32 %735:s[42], %825:v[25], %739:s[46]
	 v1: %427:v[25] = v_fma_f32 %736:s[43], %825:v[25], %740:s[47]
	 s2: %0:s[54-55] = s_mov_b64 %0:exec
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %428:v[25] = v_rcp_f32 %427:v[25]
	 v1: %429:v[2] = v_mul_f32 %426:v[2], %428:v[25]
	s_delay_alu valu_dep_1
	 s2: %0:exec = v_cmpx_ge_f32 %429:v[2], %422:v[22]
	s_cbranch_execz block:BB51
BB46
/* logical preds: BB45, / linear preds: BB45, / kind: uniform, */
	 s2: %431:s[56-57] = s_buffer_load_dwordx2 %37:s[16-19], 16
	s_wait_kmcnt imm:0
	 v1: %433:v[22] = v_fma_f32 %837:s[57], -%429:v[2], %836:s[56]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %434:v[2] = v_sub_f32 %429:v[2], %433:v[22]
	 s2: (precise)%435:vcc = v_cmp_ge_f32 %423:v[41], %434:v[2]
BB51
/* logical preds: BB46, BB45, / linear preds: BB46, BB45, / kind: uniform, merge, */
	 s2: %901:s[56-57],  s1: %900:scc = s_and_b64 %899:vcc, %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec = s_mov_b64 %959:s[54-55]
	s_delay_alu salu_cycle_1
	 s2: %902:s[54-55],  s1: %904:scc = s_and_b64 %901:s[56-57], %0:exec
BB53
/* logical preds: BB42, BB51, / linear preds: BB51, BB42, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %956:s[52-53]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %439:s[52-53],  s1: %838:scc = s_not_b64 %438:s[54-55]
	 v1: %0:v[41] = v_mov_b32 %421:v[3]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %441:v[2],  s2: %929:s[52-53] = v_subbrev_co_u32 0, 0, %439:s[52-53]
BB56
/* logical preds: BB40, / linear preds: BB53, BB40, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %961:scc = s_andn2_b64 %954:s[50-51], %0:exec
	 v1: %0:v[2] = v_mov_b32 1
BB58
/* logical preds: BB53, BB56, / linear preds: BB56, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %954:s[50-51]
BB61
/* logical preds: BB39, / linear preds: BB58, BB39, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	s_delay_alu salu_cycle_1
	 s2: %0:exec,  s1: %962:scc = s_andn2_b64 %952:s[32-33], %0:exec
	 v1: %0:v[2] = v_mov_b32 %270:v[21]
BB63
/* logical preds: BB58, BB61, / linear preds: BB61, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %952:s[32-33]
	 v1: %0:v[3] = v_mov_b32 %331:v[4]
BB68
/* logical preds: BB63, BB38, / linear preds: BB63, BB38, / kind: branch, merge, */
	 s2: %0:exec = s_mov_b64 %948:s[34-35]
	 s1: %839:scc = s_cmp_lt_u32 %352:s[39], %320:s[29]
	 s2: %449:vcc = v_cmp_eq_i32 -1, %447:v[2]
	 s2: %450:s[32-33] = s_cselect_b64 -1, 0, %839:scc
	s_waitcnt_depctr sa_sdst(0)
	 s2: %451:s[32-33],  s1: %840:scc = s_and_b64 %449:vcc, %450:s[32-33]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %964:scc = s_and_b64 %451:s[32-33], %0:exec
	s_cbranch_execz block:BB98
BB69
/* logical preds: BB68, / linear preds: BB68, / kind: branch, */
	 s2: %0:s[32-33] = s_mov_b64 %0:exec
	 s2: %0:exec = v_cmpx_nlt_f32 %285:v[36], %355:v[27]
	s_cbranch_execz block:BB91
BB70
/* logical preds: BB69, / linear preds: BB69, / kind: branch, */
	 v1: %453:v[2] = v_min_i32 %365:v[29], %361:v[28]
	 s2: %454:vcc = v_cmp_gt_i32 (latekill)%341:s[28], %361:v[28]
	 s2: %455:s[38-39] = v_cmp_gt_i32 (latekill)%346:s[37], %365:v[29]
	 s2: %456:s[38-39],  s1: %841:scc = s_and_b64 %455:s[38-39], %454:vcc
	 s2: %457:vcc = v_cmp_le_i32 0, %453:v[2]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %458:s[38-39],  s1: %842:scc = s_and_b64 %457:vcc, %456:s[38-39]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %968:s[38-39],  s1: %967:scc,  s2: %0:exec = s_and_saveexec_b64 %458:s[38-39], %0:exec
	s_cbranch_execz block:BB86
BB71
/* logical preds: BB70, / linear preds: BB70, / kind: branch, */
	 s1: %459:s[40] = s_add_f32 0.5, %354:s[40]
	 s2: %0:s[50-51] = s_mov_b64 %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 v1: %460:v[2] = v_mul_f32 %459:s[40], %307:v[38]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %461:v[2] = v_min_f32 %460:v[2], %285:v[36]
	 v1: %463:v[3] = v_fma_f32 %294:v[20], %461:v[2], %192:v[16]
	 v1: %465:v[2] = v_fma_f32 %296:v[19], %461:v[2], %182:v[11]
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %466:v[2] = v_rcp_f32 %465:v[2]
	 v1: %467:v[3] = v_mul_f32 %463:v[3], %466:v[2]
	s_delay_alu valu_dep_1
	 v1: %468:v[4] = v_min_f32 %448:v[41], %467:v[3]
	 v1: %469:v[41] = v_max_f32 %448:v[41], %467:v[3]
	s_wait_loadcnt imm:2
	 s2: %0:exec = v_cmpx_eq_f32 (latekill)%39:s[0], %827:v[30]
BB72
/* logical preds: BB71, / linear preds: BB71, / kind: uniform, */
	 s2: %0:s[52-53] = s_mov_b64 0
	 s2: %0:exec,  s1: %971:scc = s_andn2_b64 %970:s[50-51], %0:exec
	s_cbranch_execz block:BB83
BB75
/* logical preds: BB71, / linear preds: BB72, / kind: branch, */
	 v1: %472:v[2] = v_fma_f32 %735:s[42], %827:v[30], %739:s[46]
	 v1: %473:v[30] = v_fma_f32 %736:s[43], %827:v[30], %740:s[47]
	 s2: %0:s[52-53] = s_mov_b64 %0:exec
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %474:v[30] = v_rcp_f32 %473:v[30]
	 v1: %475:v[2] = v_mul_f32 %472:v[2], %474:v[30]
	s_delay_alu valu_dep_1
	 s2: %0:exec = v_cmpx_ge_f32 %475:v[2], %468:v[4]
	s_cbranch_execz block:BB81
BB76
/* logical preds: BB75, / linear preds: BB75, / kind: uniform, */
	 s2: %477:s[54-55] = s_buffer_load_dwordx2 %37:s[16-19], 16
	s_wait_kmcnt imm:0
	 v1: %479:v[4] = v_fma_f32 %846:s[55], -%475:v[2], %845:s[54]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %480:v[2] = v_sub_f32 %475:v[2], %479:v[4]
	 s2: (precise)%481:vcc = v_cmp_ge_f32 %469:v[41], %480:v[2]
BB81
/* logical preds: BB76, BB75, / linear preds: BB76, BB75, / kind: uniform, merge, */
	 s2: %907:s[54-55],  s1: %906:scc = s_and_b64 %905:vcc, %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec = s_mov_b64 %973:s[52-53]
	s_delay_alu salu_cycle_1
	 s2: %908:s[52-53],  s1: %910:scc = s_and_b64 %907:s[54-55], %0:exec
BB83
/* logical preds: BB72, BB81, / linear preds: BB81, BB72, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %970:s[50-51]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %485:s[50-51],  s1: %847:scc = s_not_b64 %484:s[52-53]
	 v1: %0:v[41] = v_mov_b32 %467:v[3]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %487:v[2],  s2: %930:s[50-51] = v_subbrev_co_u32 0, 0, %485:s[50-51]
BB86
/* logical preds: BB70, / linear preds: BB83, BB70, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %975:scc = s_andn2_b64 %968:s[38-39], %0:exec
	 v1: %0:v[2] = v_mov_b32 1
BB88
/* logical preds: BB83, BB86, / linear preds: BB86, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %968:s[38-39]
BB91
/* logical preds: BB69, / linear preds: BB88, BB69, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	s_delay_alu salu_cycle_1
	 s2: %0:exec,  s1: %976:scc = s_andn2_b64 %966:s[32-33], %0:exec
	 v1: %0:v[2] = v_mov_b32 %270:v[21]
BB93
/* logical preds: BB88, BB91, / linear preds: BB91, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %966:s[32-33]
	 v1: %0:v[3] = v_mov_b32 %355:v[27]
BB98
/* logical preds: BB93, BB68, / linear preds: BB93, BB68, / kind: branch, merge, */
	 s2: %0:exec = s_mov_b64 %948:s[34-35]
	 s1: %848:scc = s_cmp_lt_u32 %370:s[41], %320:s[29]
	 s2: %495:vcc = v_cmp_eq_i32 -1, %493:v[2]
	 s2: %496:s[32-33] = s_cselect_b64 -1, 0, %848:scc
	s_waitcnt_depctr sa_sdst(0)
	 s2: %497:s[32-33],  s1: %849:scc = s_and_b64 %495:vcc, %496:s[32-33]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %978:scc = s_and_b64 %497:s[32-33], %0:exec
	s_cbranch_execz block:BB128
BB99
/* logical preds: BB98, / linear preds: BB98, / kind: branch, */
	 s2: %0:s[32-33] = s_mov_b64 %0:exec
	 s2: %0:exec = v_cmpx_nlt_f32 %285:v[36], %373:v[32]
	s_cbranch_execz block:BB121
BB100
/* logical preds: BB99, / linear preds: BB99, / kind: branch, */
	 v1: %499:v[2] = v_min_i32 %383:v[34], %379:v[33]
	 s2: %500:vcc = v_cmp_gt_i32 (latekill)%341:s[28], %379:v[33]
	 s2: %501:s[38-39] = v_cmp_gt_i32 (latekill)%346:s[37], %383:v[34]
	 s2: %502:s[38-39],  s1: %850:scc = s_and_b64 %501:s[38-39], %500:vcc
	 s2: %503:vcc = v_cmp_le_i32 0, %499:v[2]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %504:s[38-39],  s1: %851:scc = s_and_b64 %503:vcc, %502:s[38-39]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %982:s[38-39],  s1: %981:scc,  s2: %0:exec = s_and_saveexec_b64 %504:s[38-39], %0:exec
	s_cbranch_execz block:BB116
BB101
/* logical preds: BB100, / linear preds: BB100, / kind: branch, */
	 s1: %505:s[44] = s_add_f32 0.5, %372:s[44]
	 s2: %0:s[40-41] = s_mov_b64 %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 v1: %506:v[2] = v_mul_f32 %505:s[44], %307:v[38]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %507:v[2] = v_min_f32 %506:v[2], %285:v[36]
	 v1: %509:v[3] = v_fma_f32 %294:v[20], %507:v[2], %192:v[16]
	 v1: %511:v[2] = v_fma_f32 %296:v[19], %507:v[2], %182:v[11]
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %512:v[2] = v_rcp_f32 %511:v[2]
	 v1: %513:v[3] = v_mul_f32 %509:v[3], %512:v[2]
	s_delay_alu valu_dep_1
	 v1: %514:v[4] = v_min_f32 %494:v[41], %513:v[3]
	 v1: %515:v[41] = v_max_f32 %494:v[41], %513:v[3]
	s_wait_loadcnt imm:1
	 s2: %0:exec = v_cmpx_eq_f32 (latekill)%39:s[0], %829:v[35]
BB102
/* logical preds: BB101, / linear preds: BB101, / kind: uniform, */
	 s2: %0:s[50-51] = s_mov_b64 0
	 s2: %0:exec,  s1: %985:scc = s_andn2_b64 %984:s[40-41], %0:exec
	s_cbranch_execz block:BB113
BB105
/* logical preds: BB101, / linear preds: BB102, / kind: branch, */
	 v1: %518:v[2] = v_fma_f32 %735:s[42], %829:v[35], %739:s[46]
	 v1: %519:v[35] = v_fma_f32 %736:s[43], %829:v[35], %740:s[47]
	 s2: %0:s[50-51] = s_mov_b64 %0:exec
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %520:v[35] = v_rcp_f32 %519:v[35]
	 v1: %521:v[2] = v_mul_f32 %518:v[2], %520:v[35]
	s_delay_alu valu_dep_1
	 s2: %0:exec = v_cmpx_ge_f32 %521:v[2], %514:v[4]
	s_cbranch_execz block:BB111
BB106
/* logical preds: BB105, / linear preds: BB105, / kind: uniform, */
	 s2: %523:s[52-53] = s_buffer_load_dwordx2 %37:s[16-19], 16
	s_wait_kmcnt imm:0
	 v1: %525:v[4] = v_fma_f32 %855:s[53], -%521:v[2], %854:s[52]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %526:v[2] = v_sub_f32 %521:v[2], %525:v[4]
	 s2: (precise)%527:vcc = v_cmp_ge_f32 %515:v[41], %526:v[2]
BB111
/* logical preds: BB106, BB105, / linear preds: BB106, BB105, / kind: uniform, merge, */
	 s2: %913:s[52-53],  s1: %912:scc = s_and_b64 %911:vcc, %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec = s_mov_b64 %987:s[50-51]
	s_delay_alu salu_cycle_1
	 s2: %914:s[50-51],  s1: %916:scc = s_and_b64 %913:s[52-53], %0:exec
BB113
/* logical preds: BB102, BB111, / linear preds: BB111, BB102, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %984:s[40-41]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %531:s[40-41],  s1: %856:scc = s_not_b64 %530:s[50-51]
	 v1: %0:v[41] = v_mov_b32 %513:v[3]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %533:v[2],  s2: %931:s[40-41] = v_subbrev_co_u32 0, 0, %531:s[40-41]
BB116
/* logical preds: BB100, / linear preds: BB113, BB100, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %989:scc = s_andn2_b64 %982:s[38-39], %0:exec
	 v1: %0:v[2] = v_mov_b32 1
BB118
/* logical preds: BB113, BB116, / linear preds: BB116, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %982:s[38-39]
BB121
/* logical preds: BB99, / linear preds: BB118, BB99, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	s_delay_alu salu_cycle_1
	 s2: %0:exec,  s1: %990:scc = s_andn2_b64 %980:s[32-33], %0:exec
	 v1: %0:v[2] = v_mov_b32 %270:v[21]
BB123
/* logical preds: BB118, BB121, / linear preds: BB121, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %980:s[32-33]
	 v1: %0:v[3] = v_mov_b32 %373:v[32]
BB128
/* logical preds: BB123, BB98, / linear preds: BB123, BB98, / kind: branch, merge, */
	 s2: %0:exec = s_mov_b64 %948:s[34-35]
	 s1: %857:scc = s_cmp_lt_u32 %388:s[45], %320:s[29]
	 s2: %541:vcc = v_cmp_eq_i32 -1, %539:v[2]
	 s2: %542:s[32-33] = s_cselect_b64 -1, 0, %857:scc
	s_waitcnt_depctr sa_sdst(0)
	 s2: %543:s[32-33],  s1: %858:scc = s_and_b64 %541:vcc, %542:s[32-33]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %992:scc = s_and_b64 %543:s[32-33], %0:exec
	s_cbranch_execz block:BB158
BB129
/* logical preds: BB128, / linear preds: BB128, / kind: branch, */
	 s2: %0:s[32-33] = s_mov_b64 %0:exec
	 s2: %0:exec = v_cmpx_nlt_f32 %285:v[36], %391:v[39]
	s_cbranch_execz block:BB151
BB130
/* logical preds: BB129, / linear preds: BB129, / kind: branch, */
	 v1: %545:v[2] = v_min_i32 %401:v[23], %397:v[5]
	 s2: %546:vcc = v_cmp_gt_i32 (latekill)%341:s[28], %397:v[5]
	 s2: %547:s[38-39] = v_cmp_gt_i32 (latekill)%346:s[37], %401:v[23]
	 s2: %548:s[36-37],  s1: %859:scc = s_and_b64 %547:s[38-39], %546:vcc
	 s2: %549:vcc = v_cmp_le_i32 0, %545:v[2]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %550:s[36-37],  s1: %860:scc = s_and_b64 %549:vcc, %548:s[36-37]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %996:s[36-37],  s1: %995:scc,  s2: %0:exec = s_and_saveexec_b64 %550:s[36-37], %0:exec
	s_cbranch_execz block:BB146
BB131
/* logical preds: BB130, / linear preds: BB130, / kind: branch, */
	 s1: %551:s[48] = s_add_f32 0.5, %390:s[48]
	 s2: %0:s[38-39] = s_mov_b64 %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 v1: %552:v[2] = v_mul_f32 %551:s[48], %307:v[38]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %553:v[2] = v_min_f32 %552:v[2], %285:v[36]
	 v1: %555:v[3] = v_fma_f32 %294:v[20], %553:v[2], %192:v[16]
	 v1: %557:v[2] = v_fma_f32 %296:v[19], %553:v[2], %182:v[11]
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %558:v[2] = v_rcp_f32 %557:v[2]
	 v1: %559:v[3] = v_mul_f32 %555:v[3], %558:v[2]
	s_delay_alu valu_dep_1
	 v1: %560:v[4] = v_min_f32 %540:v[41], %559:v[3]
	 v1: %561:v[41] = v_max_f32 %540:v[41], %559:v[3]
	s_wait_loadcnt imm:0
	 s2: %0:exec = v_cmpx_eq_f32 (latekill)%39:s[0], %831:v[40]
BB132
/* logical preds: BB131, / linear preds: BB131, / kind: uniform, */
	 s2: %0:s[40-41] = s_mov_b64 0
	 s2: %0:exec,  s1: %999:scc = s_andn2_b64 %998:s[38-39], %0:exec
	s_cbranch_execz block:BB143
BB135
/* logical preds: BB131, / linear preds: BB132, / kind: branch, */
	 v1: %564:v[2] = v_fma_f32 %735:s[42], %831:v[40], %739:s[46]
	 v1: %565:v[40] = v_fma_f32 %736:s[43], %831:v[40], %740:s[47]
	 s2: %0:s[40-41] = s_mov_b64 %0:exec
	s_delay_alu valu_dep_1 next trans32_dep_1
	 v1: %566:v[40] = v_rcp_f32 %565:v[40]
	 v1: %567:v[2] = v_mul_f32 %564:v[2], %566:v[40]
	s_delay_alu valu_dep_1
	 s2: %0:exec = v_cmpx_ge_f32 %567:v[2], %560:v[4]
	s_cbranch_execz block:BB141
BB136
/* logical preds: BB135, / linear preds: BB135, / kind: uniform, */
	 s2: %569:s[44-45] = s_buffer_load_dwordx2 %37:s[16-19], 16
	s_wait_kmcnt imm:0
	 v1: %571:v[4] = v_fma_f32 %864:s[45], -%567:v[2], %863:s[44]
	s_delay_alu valu_dep_1 next valu_dep_1
	 v1: %572:v[2] = v_sub_f32 %567:v[2], %571:v[4]
	 s2: (precise)%573:vcc = v_cmp_ge_f32 %561:v[41], %572:v[2]
BB141
/* logical preds: BB136, BB135, / linear preds: BB136, BB135, / kind: uniform, merge, */
	 s2: %919:s[44-45],  s1: %918:scc = s_and_b64 %917:vcc, %0:exec
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec = s_mov_b64 %1001:s[40-41]
	s_delay_alu salu_cycle_1
	 s2: %920:s[40-41],  s1: %922:scc = s_and_b64 %919:s[44-45], %0:exec
BB143
/* logical preds: BB132, BB141, / linear preds: BB141, BB132, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %998:s[38-39]
	s_waitcnt_depctr sa_sdst(0)
	 s2: %577:s[38-39],  s1: %865:scc = s_not_b64 %576:s[40-41]
	 v1: %0:v[41] = v_mov_b32 %559:v[3]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %579:v[2],  s2: %932:s[38-39] = v_subbrev_co_u32 0, 0, %577:s[38-39]
BB146
/* logical preds: BB130, / linear preds: BB143, BB130, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	 s2: %0:exec,  s1: %1003:scc = s_andn2_b64 %996:s[36-37], %0:exec
	 v1: %0:v[2] = v_mov_b32 1
BB148
/* logical preds: BB143, BB146, / linear preds: BB146, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %996:s[36-37]
BB151
/* logical preds: BB129, / linear preds: BB148, BB129, / kind: uniform, */
	s_waitcnt_depctr sa_sdst(0)
	s_delay_alu salu_cycle_1
	 s2: %0:exec,  s1: %1004:scc = s_andn2_b64 %994:s[32-33], %0:exec
	 v1: %0:v[2] = v_mov_b32 %270:v[21]
BB153
/* logical preds: BB148, BB151, / linear preds: BB151, / kind: uniform, merge, */
	 s2: %0:exec = s_mov_b64 %994:s[32-33]
	 v1: %0:v[3] = v_mov_b32 %391:v[39]
BB158
/* logical preds: BB153, BB128, / linear preds: BB153, BB128, / kind: uniform, continue, merge, */
	 s2: %0:exec = s_mov_b64 %948:s[34-35]
	 s1: %587:s[1],  s1: %866:scc = s_add_u32 %321:s[1], 4
	s_branch block:BB30
BB159
/* logical preds: BB31, / linear preds: BB31, / kind: uniform, loop-exit, */
	 s2: %0:exec = s_mov_b64 %943:s[4-5]
	s_waitcnt_depctr sa_sdst(0)
	 v1: %591:v[2] = v_cndmask_b32 %589:v[2], 3, %923:s[30-31]
	 v1: %594:v[6] = v_fmac_f32 %287:v[17], %588:v[3], %187:v[6]
	 v1: %595:v[7] = v_fmac_f32 %288:v[18], %588:v[3], %189:v[7]
	 v1: %596:v[3] = v_min_f32 %588:v[3], %285:v[36]
	s_delay_alu valu_dep_4 next valu_dep_3
	 s2: %617:vcc = v_cmp_eq_i32 0, %591:v[2]
	 v1: %616:v[4] = v_subrev_f32 %720:s[23], %595:v[7]
	 v1: %600:v[12] = v_fmac_f32 %292:v[14], %596:v[3], %190:v[12]
	 v1: %601:v[13] = v_fmac_f32 %293:v[15], %596:v[3], %191:v[13]
	 v1: %602:v[16] = v_fmac_f32 %294:v[20], %596:v[3], %192:v[16]
	 v1: %604:v[11] = v_fmac_f32 %296:v[19], %596:v[3], %182:v[11]
	 v1: %615:v[3] = v_subrev_f32 %719:s[22], %594:v[6]
	s_waitcnt_depctr va_vcc(0)
	 v1: %618:v[5] = v_cndmask_b32 %591:v[2], 0, %617:vcc
	 v1: %622:v[4] = v_floor_f32 %616:v[4]
	s_delay_alu valu_dep_4 skip_2 valu_dep_2
	 v1: %605:v[11] = v_rcp_f32 %604:v[11]
	 v1: %619:v[3] = v_floor_f32 %615:v[3]
	 v1: %623:v[4] = v_cvt_i32_f32 %622:v[4]
	 v1: %620:v[3] = v_cvt_i32_f32 %619:v[3]
	 v1: %609:v[12] = v_fma_f32 %600:v[12], %605:v[11], -%94:v[8]
	 v1: %610:v[13] = v_fma_f32 %601:v[13], %605:v[11], -%95:v[9]
	 v1: %624:v[9] = v_cndmask_b32 0, %623:v[4], %617:vcc
	 v1: %611:v[16] = v_fma_f32 %602:v[16], %605:v[11], -%96:v[10]
	 v1: %621:v[8] = v_cndmask_b32 0, %620:v[3], %617:vcc
	s_delay_alu valu_dep_3 skip_4 valu_dep_4
	 s2: %626:s[0-1] = v_cmp_lg_i32 %623:v[4], %624:v[9]
	 v1: %631:v[9] = v_cvt_f32_i32 %624:v[9]
	 v1: %612:v[16] = v_mul_f32 %611:v[16], %611:v[16]
	 s2: %625:vcc = v_cmp_lg_i32 %620:v[3], %621:v[8]
	 v1: %628:v[8] = v_cvt_f32_i32 %621:v[8]
	 v1: %632:v[9] = v_add_f32 0.5, %631:v[9]
	 v1: %613:v[16] = v_fmac_f32 %610:v[13], %610:v[13], %612:v[16]
	 s2: %627:vcc,  s1: %871:scc = s_or_b64 %626:s[0-1], %625:vcc
	 v1: %629:v[8] = v_add_f32 0.5, %628:v[8]
	s_delay_alu valu_dep_3 skip_1 valu_dep_3
	 v1: %633:v[9] = v_add_f32 %720:s[23], %632:v[9]
	 v1: %614:v[16] = v_fmac_f32 %609:v[12], %609:v[12], %613:v[16]
	 v1: %630:v[8] = v_add_f32 %719:s[22], %629:v[8]
	s_waitcnt_depctr sa_sdst(0)
	s_delay_alu valu_dep_3
	 v1: %635:v[7] = v_cndmask_b32 %595:v[7], %633:v[9], %627:vcc
	 v1: %641:v[16] = v_sqrt_f32 %614:v[16]
	 v1: %634:v[6] = v_cndmask_b32 %594:v[6], %630:v[8], %627:vcc
	 s2: %638:vcc = v_cmp_eq_i32 0, %618:v[5]
	 v1: %643:v[5] = v_max_u32 %618:v[5], %591:v[2]
	 v1: %637:v[7] = v_mul_f32 %724:s[27], %635:v[7]
	s_delay_alu valu_dep_4 skip_1 valu_dep_2
	 v1: %636:v[6] = v_mul_f32 %723:s[26], %634:v[6]
	s_waitcnt_depctr va_vcc(0)
	 v1: %640:v[9] = v_cndmask_b32 0, %637:v[7], %638:vcc
	 v1: %642:v[10] = v_cndmask_b32 0, %641:v[16], %638:vcc
	 v1: %639:v[8] = v_cndmask_b32 0, %636:v[6], %638:vcc
	 s2: %644:vcc = v_cmp_eq_i32 0, %643:v[5]
	s_waitcnt_depctr va_vcc(0)
	 v1: %645:v[11] = v_cndmask_b32 0, 1.0, %644:vcc
BB162
/* logical preds: BB25, / linear preds: BB159, BB25, / kind: uniform, */
	 s2: %0:exec,  s1: %1006:scc = s_andn2_b64 %935:s[20-21], %0:exec
	 v1: %0:v[8] = v_mov_b32 0
	 v1: %0:v[9] = v_mov_b32 0
	 v1: %0:v[10] = v_mov_b32 0
	 v1: %0:v[11] = v_mov_b32 0
BB164
/* logical preds: BB159, BB162, / linear preds: BB162, / kind: uniform, merge, */
	 s8: %651:s[0-7] = s_load_dwordx8 %31:s[2-3], 0x200
	 s2: %0:exec = s_mov_b64 %935:s[20-21]
	s_wait_kmcnt imm:0
	image_store %651:s[0-7],  s4: undef, %655:v[8-11], %7:v[1], %11:v[0] 2d unrm disable_wqm storage:image
BB169
/* logical preds: BB164, BB6, / linear preds: BB164, BB6, / kind: uniform, top-level, merge, */
	s_nop
	s_sendmsg sendmsg(dealloc_vgprs)
	s_endpgm

