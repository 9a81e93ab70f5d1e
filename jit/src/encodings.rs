//! The instructions for each width and level, as one table each.

use iced_x86::Code;

use super::Level;

/// The instructions for numbers of one width.
#[derive(Debug)]
pub struct Encodings {
    /// Load of a vector.
    pub load: Code,
    /// Store of a vector.
    pub store: Code,
    /// Copy between registers.
    pub copy: Code,
    /// Load of one number into all lanes, for several lanes.
    pub broadcast: Option<Code>,
    /// Conversion of a mask register to all ones or zeros in each lane.
    pub spread: Option<Code>,
    /// Arithmetic with two operands.
    pub add: Code,
    /// Subtraction.
    pub sub: Code,
    /// Multiplication.
    pub mul: Code,
    /// Division.
    pub div: Code,
    /// Minimum; the second operand where they are equal or one is NaN.
    pub min: Code,
    /// Maximum; the second operand where they are equal or one is NaN.
    pub max: Code,
    /// Bitwise and.
    pub and: Code,
    /// Bitwise or.
    pub or: Code,
    /// Bitwise exclusive or.
    pub xor: Code,
    /// Square root.
    pub sqrt: Code,
    /// Comparison: into a mask register with AVX-512, otherwise into all ones or zeros.
    pub compare: Code,
    /// `a·b + c`, `a·b − c`, `c − a·b`, each in the forms 132, 213 and 231.
    pub fused: [[Code; 3]; 3],
}

/// The table of a level for this number of lanes: 1, 4, or 8 with AVX-512.
pub fn encodings(level: Level, lanes: usize) -> &'static Encodings {
    match (level, lanes) {
        (Level::Avx512, 1) => &AVX512_ONE,
        (Level::Avx512, 4) => &AVX512_FOUR,
        (Level::Avx512, _) => &AVX512_EIGHT,
        (Level::Avx2, 1) => &AVX2_ONE,
        (Level::Avx2, _) => &AVX2_FOUR,
    }
}

static AVX512_ONE: Encodings = Encodings {
    load: Code::EVEX_Vmovsd_xmm_k1z_m64,
    store: Code::EVEX_Vmovsd_m64_k1_xmm,
    copy: Code::EVEX_Vmovapd_xmm_k1z_xmmm128,
    broadcast: None,
    spread: Some(Code::EVEX_Vpmovm2q_xmm_kr),
    add: Code::EVEX_Vaddsd_xmm_k1z_xmm_xmmm64_er,
    sub: Code::EVEX_Vsubsd_xmm_k1z_xmm_xmmm64_er,
    mul: Code::EVEX_Vmulsd_xmm_k1z_xmm_xmmm64_er,
    div: Code::EVEX_Vdivsd_xmm_k1z_xmm_xmmm64_er,
    min: Code::EVEX_Vminsd_xmm_k1z_xmm_xmmm64_sae,
    max: Code::EVEX_Vmaxsd_xmm_k1z_xmm_xmmm64_sae,
    and: Code::EVEX_Vandpd_xmm_k1z_xmm_xmmm128b64,
    or: Code::EVEX_Vorpd_xmm_k1z_xmm_xmmm128b64,
    xor: Code::EVEX_Vxorpd_xmm_k1z_xmm_xmmm128b64,
    sqrt: Code::EVEX_Vsqrtsd_xmm_k1z_xmm_xmmm64_er,
    compare: Code::EVEX_Vcmpsd_kr_k1_xmm_xmmm64_imm8_sae,
    fused: [
        [
            Code::EVEX_Vfmadd132sd_xmm_k1z_xmm_xmmm64_er,
            Code::EVEX_Vfmadd213sd_xmm_k1z_xmm_xmmm64_er,
            Code::EVEX_Vfmadd231sd_xmm_k1z_xmm_xmmm64_er,
        ],
        [
            Code::EVEX_Vfmsub132sd_xmm_k1z_xmm_xmmm64_er,
            Code::EVEX_Vfmsub213sd_xmm_k1z_xmm_xmmm64_er,
            Code::EVEX_Vfmsub231sd_xmm_k1z_xmm_xmmm64_er,
        ],
        [
            Code::EVEX_Vfnmadd132sd_xmm_k1z_xmm_xmmm64_er,
            Code::EVEX_Vfnmadd213sd_xmm_k1z_xmm_xmmm64_er,
            Code::EVEX_Vfnmadd231sd_xmm_k1z_xmm_xmmm64_er,
        ],
    ],
};

static AVX512_FOUR: Encodings = Encodings {
    load: Code::EVEX_Vmovupd_ymm_k1z_ymmm256,
    store: Code::EVEX_Vmovupd_ymmm256_k1z_ymm,
    copy: Code::EVEX_Vmovapd_ymm_k1z_ymmm256,
    broadcast: Some(Code::EVEX_Vbroadcastsd_ymm_k1z_xmmm64),
    spread: Some(Code::EVEX_Vpmovm2q_ymm_kr),
    add: Code::EVEX_Vaddpd_ymm_k1z_ymm_ymmm256b64,
    sub: Code::EVEX_Vsubpd_ymm_k1z_ymm_ymmm256b64,
    mul: Code::EVEX_Vmulpd_ymm_k1z_ymm_ymmm256b64,
    div: Code::EVEX_Vdivpd_ymm_k1z_ymm_ymmm256b64,
    min: Code::EVEX_Vminpd_ymm_k1z_ymm_ymmm256b64,
    max: Code::EVEX_Vmaxpd_ymm_k1z_ymm_ymmm256b64,
    and: Code::EVEX_Vandpd_ymm_k1z_ymm_ymmm256b64,
    or: Code::EVEX_Vorpd_ymm_k1z_ymm_ymmm256b64,
    xor: Code::EVEX_Vxorpd_ymm_k1z_ymm_ymmm256b64,
    sqrt: Code::EVEX_Vsqrtpd_ymm_k1z_ymmm256b64,
    compare: Code::EVEX_Vcmppd_kr_k1_ymm_ymmm256b64_imm8,
    fused: [
        [
            Code::EVEX_Vfmadd132pd_ymm_k1z_ymm_ymmm256b64,
            Code::EVEX_Vfmadd213pd_ymm_k1z_ymm_ymmm256b64,
            Code::EVEX_Vfmadd231pd_ymm_k1z_ymm_ymmm256b64,
        ],
        [
            Code::EVEX_Vfmsub132pd_ymm_k1z_ymm_ymmm256b64,
            Code::EVEX_Vfmsub213pd_ymm_k1z_ymm_ymmm256b64,
            Code::EVEX_Vfmsub231pd_ymm_k1z_ymm_ymmm256b64,
        ],
        [
            Code::EVEX_Vfnmadd132pd_ymm_k1z_ymm_ymmm256b64,
            Code::EVEX_Vfnmadd213pd_ymm_k1z_ymm_ymmm256b64,
            Code::EVEX_Vfnmadd231pd_ymm_k1z_ymm_ymmm256b64,
        ],
    ],
};

static AVX512_EIGHT: Encodings = Encodings {
    load: Code::EVEX_Vmovupd_zmm_k1z_zmmm512,
    store: Code::EVEX_Vmovupd_zmmm512_k1z_zmm,
    copy: Code::EVEX_Vmovapd_zmm_k1z_zmmm512,
    broadcast: Some(Code::EVEX_Vbroadcastsd_zmm_k1z_xmmm64),
    spread: Some(Code::EVEX_Vpmovm2q_zmm_kr),
    add: Code::EVEX_Vaddpd_zmm_k1z_zmm_zmmm512b64_er,
    sub: Code::EVEX_Vsubpd_zmm_k1z_zmm_zmmm512b64_er,
    mul: Code::EVEX_Vmulpd_zmm_k1z_zmm_zmmm512b64_er,
    div: Code::EVEX_Vdivpd_zmm_k1z_zmm_zmmm512b64_er,
    min: Code::EVEX_Vminpd_zmm_k1z_zmm_zmmm512b64_sae,
    max: Code::EVEX_Vmaxpd_zmm_k1z_zmm_zmmm512b64_sae,
    and: Code::EVEX_Vandpd_zmm_k1z_zmm_zmmm512b64,
    or: Code::EVEX_Vorpd_zmm_k1z_zmm_zmmm512b64,
    xor: Code::EVEX_Vxorpd_zmm_k1z_zmm_zmmm512b64,
    sqrt: Code::EVEX_Vsqrtpd_zmm_k1z_zmmm512b64_er,
    compare: Code::EVEX_Vcmppd_kr_k1_zmm_zmmm512b64_imm8_sae,
    fused: [
        [
            Code::EVEX_Vfmadd132pd_zmm_k1z_zmm_zmmm512b64_er,
            Code::EVEX_Vfmadd213pd_zmm_k1z_zmm_zmmm512b64_er,
            Code::EVEX_Vfmadd231pd_zmm_k1z_zmm_zmmm512b64_er,
        ],
        [
            Code::EVEX_Vfmsub132pd_zmm_k1z_zmm_zmmm512b64_er,
            Code::EVEX_Vfmsub213pd_zmm_k1z_zmm_zmmm512b64_er,
            Code::EVEX_Vfmsub231pd_zmm_k1z_zmm_zmmm512b64_er,
        ],
        [
            Code::EVEX_Vfnmadd132pd_zmm_k1z_zmm_zmmm512b64_er,
            Code::EVEX_Vfnmadd213pd_zmm_k1z_zmm_zmmm512b64_er,
            Code::EVEX_Vfnmadd231pd_zmm_k1z_zmm_zmmm512b64_er,
        ],
    ],
};

static AVX2_ONE: Encodings = Encodings {
    load: Code::VEX_Vmovsd_xmm_m64,
    store: Code::VEX_Vmovsd_m64_xmm,
    copy: Code::VEX_Vmovapd_xmm_xmmm128,
    broadcast: None,
    spread: None,
    add: Code::VEX_Vaddsd_xmm_xmm_xmmm64,
    sub: Code::VEX_Vsubsd_xmm_xmm_xmmm64,
    mul: Code::VEX_Vmulsd_xmm_xmm_xmmm64,
    div: Code::VEX_Vdivsd_xmm_xmm_xmmm64,
    min: Code::VEX_Vminsd_xmm_xmm_xmmm64,
    max: Code::VEX_Vmaxsd_xmm_xmm_xmmm64,
    and: Code::VEX_Vandpd_xmm_xmm_xmmm128,
    or: Code::VEX_Vorpd_xmm_xmm_xmmm128,
    xor: Code::VEX_Vxorpd_xmm_xmm_xmmm128,
    sqrt: Code::VEX_Vsqrtsd_xmm_xmm_xmmm64,
    compare: Code::VEX_Vcmpsd_xmm_xmm_xmmm64_imm8,
    fused: [
        [
            Code::VEX_Vfmadd132sd_xmm_xmm_xmmm64,
            Code::VEX_Vfmadd213sd_xmm_xmm_xmmm64,
            Code::VEX_Vfmadd231sd_xmm_xmm_xmmm64,
        ],
        [
            Code::VEX_Vfmsub132sd_xmm_xmm_xmmm64,
            Code::VEX_Vfmsub213sd_xmm_xmm_xmmm64,
            Code::VEX_Vfmsub231sd_xmm_xmm_xmmm64,
        ],
        [
            Code::VEX_Vfnmadd132sd_xmm_xmm_xmmm64,
            Code::VEX_Vfnmadd213sd_xmm_xmm_xmmm64,
            Code::VEX_Vfnmadd231sd_xmm_xmm_xmmm64,
        ],
    ],
};

static AVX2_FOUR: Encodings = Encodings {
    load: Code::VEX_Vmovupd_ymm_ymmm256,
    store: Code::VEX_Vmovupd_ymmm256_ymm,
    copy: Code::VEX_Vmovapd_ymm_ymmm256,
    broadcast: Some(Code::VEX_Vbroadcastsd_ymm_m64),
    spread: None,
    add: Code::VEX_Vaddpd_ymm_ymm_ymmm256,
    sub: Code::VEX_Vsubpd_ymm_ymm_ymmm256,
    mul: Code::VEX_Vmulpd_ymm_ymm_ymmm256,
    div: Code::VEX_Vdivpd_ymm_ymm_ymmm256,
    min: Code::VEX_Vminpd_ymm_ymm_ymmm256,
    max: Code::VEX_Vmaxpd_ymm_ymm_ymmm256,
    and: Code::VEX_Vandpd_ymm_ymm_ymmm256,
    or: Code::VEX_Vorpd_ymm_ymm_ymmm256,
    xor: Code::VEX_Vxorpd_ymm_ymm_ymmm256,
    sqrt: Code::VEX_Vsqrtpd_ymm_ymmm256,
    compare: Code::VEX_Vcmppd_ymm_ymm_ymmm256_imm8,
    fused: [
        [
            Code::VEX_Vfmadd132pd_ymm_ymm_ymmm256,
            Code::VEX_Vfmadd213pd_ymm_ymm_ymmm256,
            Code::VEX_Vfmadd231pd_ymm_ymm_ymmm256,
        ],
        [
            Code::VEX_Vfmsub132pd_ymm_ymm_ymmm256,
            Code::VEX_Vfmsub213pd_ymm_ymm_ymmm256,
            Code::VEX_Vfmsub231pd_ymm_ymm_ymmm256,
        ],
        [
            Code::VEX_Vfnmadd132pd_ymm_ymm_ymmm256,
            Code::VEX_Vfnmadd213pd_ymm_ymm_ymmm256,
            Code::VEX_Vfnmadd231pd_ymm_ymm_ymmm256,
        ],
    ],
};
