! SPDX-License-Identifier: MIT
!
! kit.f90 - waveform.h, iqn.h and rk.h for Fortran 2008: interfaces to copy into a program
!
! Link with the headers' implementation, made by a C compiler:
!     cc -O2 -c -DWF_IMPLEMENTATION -x c waveform.h -o waveform.o        (IQN_ and RK_ alike)
!
! Handles are type(c_ptr).  Columns, blocks and stages count from 0: declare x(n, 0:m-1), and column
! j is x(:, j). mem is an array of real(c_double) with the target attribute, bytes = 8*size(mem); it
! lives as long as the handle and is never reallocated.  Where C takes NULL, or the same array
! twice, pass c_loc(array) or c_null_ptr.  Names end in c_null_char.  What each routine does is said
! in the headers; negative results are errors, kit_text tells which.
module kit
    use, intrinsic :: iso_c_binding
    implicit none
    public

    integer, parameter :: kit_long = c_intptr_t ! C's ptrdiff_t: numbers of unknowns and strides

    ! The C structs below.  c_f_pointer(rk_find('rk4'//c_null_char), T) makes a Fortran pointer of a
    ! table, and of its arrays, for instance c_f_pointer(T%c, c, [T%stages + T%extra]).  Callbacks
    ! are passed as c_funloc(your function).

    ! made from the headers: begin
    integer(c_int), parameter :: wf_remark = 1000000000, wf_ok = 0, wf_allnan = 1000000106, &
        wf_extrap = 1000000110, wf_noisy = 1000000109, wf_lowered = 1000000108, &
        wf_sliver = 1000000107, wf_earg = -101, wf_emem = -102, wf_eorder = -103, &
        wf_enull = -104, wf_eoverlap = -106, wf_efull = -110, wf_efew = -111, wf_erange = -112, &
        wf_eextrap = -113, wf_enoisy = -114, wf_etwice = -115, wf_estale = -116, &
        wf_espent = -117, wf_eslope = -118, wf_enoslope = -119, wf_edegree = -120, &
        wf_max_degree = 15, wf_slope = 1, wf_break = 2, wf_behind = 1024, wf_auto = -1, &
        wf_misses = 80, iqn_remark = 200, iqn_ok = 0, iqn_solved = 201, iqn_relaxed = 202, &
        iqn_dropped = 203, iqn_withdrawn = 204, iqn_stalled = 206, iqn_noise = 207, &
        iqn_diverged = 208, iqn_explored = 209, iqn_uncommitted = 210, iqn_nopair = 211, &
        iqn_notbest = 212, iqn_earg = -201, iqn_emem = -202, iqn_eorder = -203, &
        iqn_enull = -204, iqn_enan = -205, iqn_eoverlap = -206, iqn_ekey = -210, &
        iqn_evalue = -211, iqn_elength = -212, iqn_esum = -213, iqn_edots = -214, &
        iqn_ehost = -215, iqn_method = 1, iqn_omega = 2, iqn_filter_limit = 4, iqn_windows = 5, &
        iqn_tol_absolute = 7, iqn_tol_relative = 8
    integer(c_int), parameter :: iqn_tol_reduction = 9, iqn_max_iterations = 11, &
        iqn_patience = 12, iqn_mixing = 14, iqn_noise_level = 21, iqn_growth = 22, &
        iqn_merge = 23, iqn_product_error = 24, iqn_length = 51, iqn_scaling = 52, &
        iqn_weight = 53, iqn_lower = 55, iqn_upper = 56, iqn_residual = 101, iqn_value = 102, &
        iqn_relative = 103, iqn_reduction = 104, iqn_best_relative = 105, iqn_pairs = 106, &
        iqn_iterations = 107, iqn_omega_now = 108, iqn_predicted = 109, iqn_nsteps = 151, &
        iqn_nsums = 152, iqn_ndropped = 153, iqn_nfull = 154, iqn_nzero = 155, &
        iqn_nrelaxed = 156, iqn_nwithdrawn = 157, iqn_nrefused = 159, iqn_nstalled = 160, &
        iqn_nexplored = 161, iqn_ils = 0, iqn_imvj = 1, iqn_aitken = 2, iqn_constant = 3, &
        iqn_by_weight = 0, iqn_by_value = 1, iqn_by_residual = 2, iqn_by_residual_sum = 3, &
        iqn_host = -2, iqn_dot_rr = 0, iqn_dot_hh = 1, iqn_dot_vv = 2, iqn_dot_vr = 3, &
        iqn_dot_ss = 4, iqn_dot_sv = 5, iqn_dots = 6, rk_remark = 300, rk_ok = 0, &
        rk_nonfinite = 302, rk_rowsum = 303, rk_less = 304, rk_reject = 305, &
        rk_unbounded = 306, rk_passed = 307, rk_extrap = 310, rk_earg = -301, rk_emem = -302, &
        rk_enull = -304
    integer(c_int), parameter :: rk_enan = -305, rk_eoverlap = -306, rk_etimes = -310, &
        rk_ename = -311, rk_enodense = -312, rk_enopair = -313, rk_etable = -314, &
        rk_estep = -315, rk_epair = -316, rk_edense = -317, rk_etiny = -318, rk_eother = -319, &
        rk_eexplicit = -320, rk_efailures = -321, rk_explicit = 1, rk_sequential = 2, &
        rk_stiffly_accurate = 3, rk_fsal = 4, rk_gauss = 1, rk_radau_iia = 2, &
        rk_lobatto_iiia = 3, rk_lobatto_iiib = 4, rk_lobatto_iiic = 5, rk_from_last = 0, &
        rk_from_start = 1, rk_groups = 2, rk_relaxed = 3
    type, bind(c) :: rk_table
        type(c_ptr) :: name
        integer(c_int) :: stages
        integer(c_int) :: order,order_hat
        integer(c_int) :: powers
        integer(c_int) :: dense_order
        integer(c_int) :: extra
        type(c_ptr) :: a
        type(c_ptr) :: b,c
        type(c_ptr) :: bhat
        type(c_ptr) :: e
        type(c_ptr) :: d
        type(c_ptr) :: e3
        integer(c_int) :: dense_stiff
    end type
    type, bind(c) :: rk_step
        type(c_ptr) :: t
        real(c_double) :: h
        integer(kit_long) :: n
        type(c_ptr) :: y,k
        integer(kit_long) :: ldk
    end type
    type, bind(c) :: rk_control
        real(c_double) :: k(5)
        real(c_double) :: safety
        real(c_double) :: grow,first
        real(c_double) :: shrink,again
        real(c_double) :: accept
        real(c_double) :: least
        real(c_double) :: stop,start
        real(c_double) :: smallest,largest
        integer(c_int) :: order
        real(c_double) :: wanted,cut
        real(c_double) :: e(2),h(2)
        integer(c_int) :: steps,rejected
    end type
    type, bind(c) :: rk_coupling
        type(c_ptr) :: name
        integer(c_int) :: form
        integer(c_int) :: stages,order,order_hat
        integer(c_int) :: powers
        type(c_ptr) :: c
        type(c_ptr) :: w
        type(c_ptr) :: g
        type(c_ptr) :: groups
    end type
    abstract interface
        integer(c_int) function iqn_sum(v, count, ctx) bind(c)
            import
            real(c_double), intent(inout) :: v(*)
            integer(c_int), value :: count
            type(c_ptr), value :: ctx
        end function
    end interface
    interface
        ! waveform.h
        integer(c_size_t) function wf_size(n, degree, capacity) bind(c)
            import
            integer(kit_long), value :: n
            integer(c_int), value :: degree, capacity
        end function
        integer(c_int) function wf_make(w, n, degree, capacity, mem, bytes) bind(c)
            import
            type(c_ptr), intent(out) :: w
            integer(kit_long), value :: n
            integer(c_int), value :: degree, capacity
            real(c_double), intent(inout), target :: mem(*)
            integer(c_size_t), value :: bytes
        end function
        integer(c_int) function wf_push(w, t, what) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), value :: t
            integer(c_int), value :: what
        end function
        type(c_ptr) function wf_column(w, j) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: j
        end function
        integer(c_int) function wf_begin(w, degree, count, t, what) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: degree, count
            real(c_double), intent(in) :: t(*)
            integer(c_int), value :: what
        end function
        integer(c_int) function wf_read(w, t, deriv, out) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), value :: t
            integer(c_int), value :: deriv
            real(c_double), intent(inout) :: out(*)
        end function
        integer(c_int) function wf_mean(w, a, b, out) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), value :: a, b
            real(c_double), intent(inout) :: out(*)
        end function
        integer(c_int) function wf_advance(w, history) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: history
        end function
        integer(c_int) function wf_rollback(w) bind(c)
            import
            type(c_ptr), value :: w
        end function
        integer(c_int) function wf_pop(w) bind(c)
            import
            type(c_ptr), value :: w
        end function
        integer(c_int) function wf_columns(w) bind(c)
            import
            type(c_ptr), value :: w
        end function
        integer(c_int) function wf_start(w) bind(c)
            import
            type(c_ptr), value :: w
        end function
        integer(c_int) function wf_degree(w) bind(c)
            import
            type(c_ptr), value :: w
        end function
        real(c_double) function wf_time(w, j) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: j
        end function
        integer(c_int) function wf_what(w, j) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: j
        end function
        real(c_double) function wf_next_break(w, t) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), value :: t
        end function
        integer(c_int) function wf_strict(w, level) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: level
        end function
        integer(c_int) function wf_restrict(w, degree, history) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: degree, history
        end function
        real(c_double) function wf_valid_from(w) bind(c)
            import
            type(c_ptr), value :: w
        end function
        integer(c_int) function wf_monotone(w) bind(c)
            import
            type(c_ptr), value :: w
        end function
        integer(c_int) function wf_copy(to, from) bind(c)
            import
            type(c_ptr), value :: to, from
        end function
        integer(c_int) function wf_resample(from, to) bind(c)
            import
            type(c_ptr), value :: from, to
        end function
        integer(c_int) function wf_fit(w, c) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), intent(inout) :: c(*)
        end function
        integer(c_int) function wf_eval(w, t, deriv, c, out) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), value :: t
            integer(c_int), value :: deriv
            real(c_double), intent(in) :: c(*)
            real(c_double), intent(inout) :: out(*)
        end function
        integer(c_int) function wf_weights(w, t, deriv, weight) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), value :: t
            integer(c_int), value :: deriv
            real(c_double), intent(inout) :: weight(*)
        end function
        integer(c_int) function wf_weights_mean(w, a, b, weight) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), value :: a, b
            real(c_double), intent(inout) :: weight(*)
        end function
        integer(c_int) function wf_predict(w, degree, t, weight) bind(c)
            import
            type(c_ptr), value :: w
            integer(c_int), value :: degree
            real(c_double), value :: t
            real(c_double), intent(inout) :: weight(*)
        end function
        integer(c_int) function wf_combine(count, columns, weight, n, x, ldx, y, ldy) bind(c)
            import
            integer(c_int), value :: count, columns
            real(c_double), intent(in) :: weight(*)
            integer(kit_long), value :: n
            real(c_double), intent(in) :: x(*)
            integer(kit_long), value :: ldx
            real(c_double), intent(inout) :: y(*)
            integer(kit_long), value :: ldy
        end function
        integer(c_int) function wf_foretell(w, squares) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), intent(inout) :: squares(*)
        end function
        integer(c_int) function wf_error(w, other, out) bind(c)
            import
            type(c_ptr), value :: w, other
            real(c_double), intent(inout) :: out(*)
        end function
        integer(c_int) function wf_choose(w, other, estimate) bind(c)
            import
            type(c_ptr), value :: w, other
            real(c_double), intent(inout) :: estimate(*)
        end function
        integer(c_int) function wf_quality(w, noise) bind(c)
            import
            type(c_ptr), value :: w
            real(c_double), intent(inout) :: noise(*)
        end function
        integer(c_int) function wf_linked_version() bind(c)
            import
        end function
        type(c_ptr) function wf_message(status) bind(c)
            import
            integer(c_int), value :: status
        end function
        ! iqn.h
        integer(c_size_t) function iqn_size(n, columns, blocks) bind(c)
            import
            integer(kit_long), value :: n
            integer(c_int), value :: columns, blocks
        end function
        integer(c_int) function iqn_make(q, n, columns, blocks, mem, bytes) bind(c)
            import
            type(c_ptr), intent(out) :: q
            integer(kit_long), value :: n
            integer(c_int), value :: columns, blocks
            real(c_double), intent(inout), target :: mem(*)
            integer(c_size_t), value :: bytes
        end function
        integer(c_int) function iqn_set(q, key, value) bind(c)
            import
            type(c_ptr), value :: q
            integer(c_int), value :: key
            real(c_double), value :: value
        end function
        integer(c_int) function iqn_set_block(q, block, key, value) bind(c)
            import
            type(c_ptr), value :: q
            integer(c_int), value :: block, key
            real(c_double), value :: value
        end function
        real(c_double) function iqn_get(q, key) bind(c)
            import
            type(c_ptr), value :: q
            integer(c_int), value :: key
        end function
        real(c_double) function iqn_get_block(q, block, key) bind(c)
            import
            type(c_ptr), value :: q
            integer(c_int), value :: block, key
        end function
        integer(c_int) function iqn_step(q, x, hx) bind(c)
            import
            type(c_ptr), value :: q
            real(c_double), intent(inout) :: x(*)
            real(c_double), intent(in) :: hx(*)
        end function
        integer(c_int) function iqn_halve(q, x) bind(c)
            import
            type(c_ptr), value :: q, x
        end function
        integer(c_int) function iqn_best(q, x, hx) bind(c)
            import
            type(c_ptr), value :: q, x, hx
        end function
        integer(c_int) function iqn_converged(q) bind(c)
            import
            type(c_ptr), value :: q
        end function
        integer(c_int) function iqn_commit(q) bind(c)
            import
            type(c_ptr), value :: q
        end function
        integer(c_int) function iqn_discard(q) bind(c)
            import
            type(c_ptr), value :: q
        end function
        type(c_ptr) function iqn_message(status) bind(c)
            import
            integer(c_int), value :: status
        end function
        integer(c_int) function iqn_linked_version() bind(c)
            import
        end function
        integer(c_int) function iqn_changed(q) bind(c)
            import
            type(c_ptr), value :: q
        end function
        integer(c_int) function iqn_set_sum(q, sum, ctx) bind(c)
            import
            type(c_ptr), value :: q
            type(c_funptr), value :: sum
            type(c_ptr), value :: ctx
        end function
        integer(c_int) function iqn_push(q, v, w) bind(c)
            import
            type(c_ptr), value :: q
            real(c_double), intent(in) :: v(*), w(*)
        end function
        integer(c_int) function iqn_pair(q, j, v, w) bind(c)
            import
            type(c_ptr), value :: q
            integer(c_int), value :: j
            type(c_ptr), value :: v, w
        end function
        integer(c_int) function iqn_delay(q) bind(c)
            import
            type(c_ptr), value :: q
        end function
        integer(c_int) function iqn_ask(q, slot) bind(c)
            import
            type(c_ptr), value :: q
            integer(c_int), intent(inout) :: slot(*)
        end function
        integer(c_int) function iqn_weights(q, dot, weight, store) bind(c)
            import
            type(c_ptr), value :: q
            real(c_double), intent(in) :: dot(*)
            real(c_double), intent(inout) :: weight(*)
            integer(c_int), intent(inout) :: store(*)
        end function
        integer(c_int) function iqn_push_dots(q, dot) bind(c)
            import
            type(c_ptr), value :: q
            real(c_double), intent(in) :: dot(*)
        end function
        ! rk.h
        type(c_ptr) function rk_find(name) bind(c)
            import
            character(kind=c_char), intent(in) :: name(*)
        end function
        integer(c_int) function rk_is(tab, property) bind(c)
            import
            type(rk_table), intent(in) :: tab
            integer(c_int), value :: property
        end function
        integer(c_int) function rk_stage(tab, i, h, n, y, k, ldk, z) bind(c)
            import
            type(rk_table), intent(in) :: tab
            integer(c_int), value :: i
            real(c_double), value :: h
            integer(kit_long), value :: n
            real(c_double), intent(in) :: y(*), k(*)
            integer(kit_long), value :: ldk
            real(c_double), intent(inout) :: z(*)
        end function
        integer(c_int) function rk_update(tab, h, n, y, k, ldk, ynew, err) bind(c)
            import
            type(rk_table), intent(in) :: tab
            real(c_double), value :: h
            integer(kit_long), value :: n
            real(c_double), intent(in) :: y(*), k(*)
            integer(kit_long), value :: ldk
            type(c_ptr), value :: ynew, err
        end function
        integer(c_int) function rk_dense(s, theta, deriv, out) bind(c)
            import
            type(rk_step), intent(in) :: s
            real(c_double), value :: theta
            integer(c_int), value :: deriv
            real(c_double), intent(inout) :: out(*)
        end function
        integer(c_int) function rk_norm(rtol, atol, size, n, v, y0, y1, sum) bind(c)
            import
            real(c_double), value :: rtol, atol
            type(c_ptr), value :: size
            integer(kit_long), value :: n
            real(c_double), intent(in) :: v(*), y0(*), y1(*)
            real(c_double), intent(inout) :: sum(*)
        end function
        real(c_double) function rk_rms(sum) bind(c)
            import
            real(c_double), intent(in) :: sum(*)
        end function
        integer(c_int) function rk_control_make(C, method, tab) bind(c)
            import
            type(rk_control), intent(inout) :: C
            character(kind=c_char), intent(in) :: method(*)
            type(rk_table), intent(in) :: tab
        end function
        integer(c_int) function rk_control_step(C, error, t, h) bind(c)
            import
            type(rk_control), intent(inout) :: C
            real(c_double), value :: error
            real(c_double), intent(inout) :: t(*), h(*)
        end function
        integer(c_int) function rk_control_stop(C, stop, t, h) bind(c)
            import
            type(rk_control), intent(inout) :: C
            real(c_double), value :: stop, t
            real(c_double), intent(inout) :: h(*)
        end function
        real(c_double) function rk_time(C, node, t, h) bind(c)
            import
            type(rk_control), intent(in) :: C
            real(c_double), value :: node, t, h
        end function
        real(c_double) function rk_first_step(order, length, d0, d1, d2) bind(c)
            import
            integer(c_int), value :: order
            real(c_double), value :: length, d0, d1, d2
        end function
        type(c_ptr) function rk_message(status) bind(c)
            import
            integer(c_int), value :: status
        end function
        type(c_ptr) function rk_tables() bind(c)
            import
        end function
        integer(c_int) function rk_collocation(tab, family, stages, mem, bytes) bind(c)
            import
            type(rk_table), intent(inout) :: tab
            integer(c_int), value :: family, stages
            real(c_double), intent(inout), target :: mem(*)
            integer(c_size_t), value :: bytes
        end function
        integer(c_size_t) function rk_collocation_size(stages) bind(c)
            import
            integer(c_int), value :: stages
        end function
        integer(c_int) function rk_stages(tab, h, n, y, k, ldk, z, ldz) bind(c)
            import
            type(rk_table), intent(in) :: tab
            real(c_double), value :: h
            integer(kit_long), value :: n
            real(c_double), intent(in) :: y(*), k(*)
            integer(kit_long), value :: ldk
            real(c_double), intent(inout) :: z(*)
            integer(kit_long), value :: ldz
        end function
        integer(c_int) function rk_combine(h, slopes, weight, n, y, k, ldk, out) bind(c)
            import
            real(c_double), value :: h
            integer(c_int), value :: slopes
            real(c_double), intent(in) :: weight(*)
            integer(kit_long), value :: n
            type(c_ptr), value :: y
            real(c_double), intent(in) :: k(*)
            integer(kit_long), value :: ldk
            real(c_double), intent(inout) :: out(*)
        end function
        integer(c_int) function rk_dense_many(s, deriv, count, theta, out, ldout) bind(c)
            import
            type(rk_step), intent(in) :: s
            integer(c_int), value :: deriv, count
            real(c_double), intent(in) :: theta(*)
            real(c_double), intent(inout) :: out(*)
            integer(kit_long), value :: ldout
        end function
        integer(c_int) function rk_weights(tab, theta, deriv, weight) bind(c)
            import
            type(rk_table), intent(in) :: tab
            real(c_double), value :: theta
            integer(c_int), value :: deriv
            real(c_double), intent(inout) :: weight(*)
        end function
        real(c_double) function rk_combined_error(error, third) bind(c)
            import
            real(c_double), value :: error, third
        end function
        integer(c_int) function rk_error_order(tab) bind(c)
            import
            type(rk_table), intent(in) :: tab
        end function
        integer(c_int) function rk_control_order(C, method, order) bind(c)
            import
            type(rk_control), intent(inout) :: C
            character(kind=c_char), intent(in) :: method(*)
            integer(c_int), value :: order
        end function
        type(c_ptr) function rk_coupling_find(name) bind(c)
            import
            character(kind=c_char), intent(in) :: name(*)
        end function
        type(c_ptr) function rk_couplings() bind(c)
            import
        end function
        integer(c_int) function rk_coupling_from(C, i) bind(c)
            import
            type(rk_coupling), intent(in) :: C
            integer(c_int), value :: i
        end function
        real(c_double) function rk_coupling_time(C, i) bind(c)
            import
            type(rk_coupling), intent(in) :: C
            integer(c_int), value :: i
        end function
        integer(c_int) function rk_coupling_forcing(C, i, w) bind(c)
            import
            type(rk_coupling), intent(in) :: C
            integer(c_int), value :: i
            real(c_double), intent(inout) :: w(*)
        end function
        integer(c_int) function rk_coupling_jump(C, i, g) bind(c)
            import
            type(rk_coupling), intent(in) :: C
            integer(c_int), value :: i
            real(c_double), intent(inout) :: g(*)
        end function
        integer(c_int) function rk_mis(C, tab, form, mem, bytes) bind(c)
            import
            type(rk_coupling), intent(inout) :: C
            type(rk_table), intent(in) :: tab
            integer(c_int), value :: form
            real(c_double), intent(inout), target :: mem(*)
            integer(c_size_t), value :: bytes
        end function
        integer(c_size_t) function rk_mis_size(stages) bind(c)
            import
            integer(c_int), value :: stages
        end function
        integer(c_int) function rk_linked_version() bind(c)
            import
        end function
    end interface
    ! made from the headers: end

contains

    function kit_text(message) result(text) ! of wf_message and its like, as a Fortran string
        type(c_ptr), intent(in) :: message
        character(len=:), allocatable :: text
        character(kind=c_char), pointer :: letter(:)
        integer :: i
        call c_f_pointer(message, letter, [1000])
        text = ''
        do i = 1, size(letter)
            if (letter(i) == c_null_char) exit
            text = text // letter(i)
        end do
    end function
end module kit
