// The exports for machines with unilateral contacts. This text follows `export.rs`.

use machine::CONTACTS;

const C: usize = CONTACTS.len();

/// Replaces the rows of constraints if there are none.
fn no_rows(_: &Prepared<f64>, _: f64, _: &[f64; N], _: &[f64; N], result: &mut [f64]) {
    result.fill(f64::NAN);
}

/// A quantity of the machine as a function of prepared values, time, coordinates and rates.
type Quantity = fn(&Prepared<f64>, f64, &[f64; N], &[f64; N], &mut [f64]);

/// Writes quantities to their destinations, or NaN if `eval_setup` was not called.
///
/// # Safety
/// `y` must point to a state; each destination must be null or point to as many numbers as given beside it, without
/// overlap with the inputs.
unsafe fn put(y: *const f64, t: f64, quantities: &[(*mut f64, usize, Quantity)]) {
    // SAFETY: guaranteed by the caller; the slot is not written meanwhile.
    unsafe {
        let [q, v] = &*y.cast::<[[f64; N]; 2]>();
        let prepared = (*ONE.0.get()).as_ref();
        for &(place, count, quantity) in quantities {
            if place.is_null() || count == 0 {
                continue;
            }
            let result = core::slice::from_raw_parts_mut(place, count);
            match prepared {
                Some(prepared) => quantity(prepared, t, q, v, result),
                None => result.fill(f64::NAN),
            }
        }
    }
}

/// # Safety
/// The header states the requirements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eval_contacts(
    y: *const f64,
    t: f64,
    gaps: *mut f64,
    rates: *mut f64,
    rows: *mut f64,
    bias: *mut f64,
    coefficients: *mut f64,
) {
    let quantities: [(*mut f64, usize, Quantity); 5] = [
        (gaps, C, machine::gaps_of),
        (rates, 2 * C, machine::contact_rates_of),
        (rows, 2 * C * N, machine::contact_matrix_of),
        (bias, 2 * C, machine::contact_bias_of),
        (coefficients, 4 * C, machine::contact_coefficients_of),
    ];
    // SAFETY: guaranteed by the caller.
    unsafe { put(y, t, &quantities) }
}

/// # Safety
/// The header states the requirements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eval_inertia(
    y: *const f64,
    t: f64,
    mass: *mut f64,
    constraints: *mut f64,
) {
    let quantities: [(*mut f64, usize, Quantity); 2] = [
        (mass, N * N, machine::mass_matrix_of),
        (constraints, CONSTRAINTS * N, constraint_rows),
    ];
    // SAFETY: guaranteed by the caller.
    unsafe { put(y, t, &quantities) }
}

tables! {
    CONTACTS: contacts {
        contact_name: *const c_char = (name, ..) => name.as_ptr(), else null();
        contact_law: *const c_char = (_, law, _) => law.as_ptr(), else null();
        contact_leans: c_int = (.., leans) => *leans, else -1;
    }
}
